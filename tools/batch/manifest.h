// A list of pairs to be retargeted (docs/batch.md): CSV, JSON lines or YAML, told by content. A row
// names a pair; its columns are options of the program ("clip_a", "template-at") and settings
// ("weights.tangle"). A column with several values is a sweep: the row stands for one pair of each.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace retarget::batch {

// An option of the program that a column may give.
struct Option {
  std::string name;  // without dashes in front: "clip-a"
  bool is_flag = false;
};

// One pair to be run.
struct Pair {
  std::string id;      // also the name of its folder; of a sweep "ID@weights.tangle=5"
  std::string row_id;  // of the manifest's row
  std::string place;   // "pairs.csv:3"
  // What it sets, by canonical name (options with '-', settings with '.'), in the manifest's order;
  // the paths of files as they can be opened from the current folder.
  std::vector<std::pair<std::string, std::string>> columns = {};
  std::vector<std::string> swept = {};  // the columns of them that are swept

  // Empty where it has no such column.
  std::string Column(const std::string& name) const;
};

// Columns that every row gets that does not give them: "name=value" each.
using Common = std::vector<std::string>;

// The pairs of a manifest, in its order. Paths are those of the manifest's folder, or else of the
// current one. Throws InputError: file:line, the column, what was expected, the nearest valid name.
std::vector<Pair> ReadManifest(const std::string& path, const std::vector<Option>& options,
                               const Common& common);
std::vector<Pair> ParseManifest(const std::string& text, const std::string& name,
                                const std::string& folder, const std::vector<Option>& options,
                                const Common& common);

}  // namespace retarget::batch
