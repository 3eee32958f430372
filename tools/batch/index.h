// The index of a batch: a table for machines, a page for people. Neither says when or how fast a
// pair was run, so that a batch that was stopped and resumed has the index of one that was not.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/batch/status.h"

namespace retarget::batch {

struct IndexRow {
  Pair pair;
  std::optional<Record> record;  // nothing: not run yet
};

// id, exit_code, missed, error, the columns of the manifest, every metric, hash.
std::string FormatIndexCsv(const std::vector<IndexRow>& rows);

// One page without scripts from elsewhere: a table that can be sorted, with pictures and links to
// the folders beside it, and of every swept column the curve of each metric over it.
std::string FormatIndexPage(const std::vector<IndexRow>& rows);

// "met", "tangle 1 missed", "limit hit", "no result", "not run".
std::string OutcomeOf(const std::optional<Record>& record);

// The pairs of a batch as its folder keeps them (manifest.jsonl).
std::string FormatPairs(const std::vector<Pair>& pairs);
std::vector<Pair> ReadPairs(const std::string& folder);  // throws InputError

}  // namespace retarget::batch
