#include "tools/batch/patterns.h"

#include <fmt/format.h>
#include <glob.h>

#include <filesystem>
#include <map>

#include "io/text/csv.h"
#include "model/geometry/types.h"

namespace retarget::batch {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> FilesOf(const std::string& pattern) {
  glob_t found{};
  const int code = glob(pattern.c_str(), GLOB_TILDE, nullptr, &found);
  std::vector<std::string> files;
  if (code == 0) files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  std::erase_if(files, [](const std::string& file) { return fs::is_directory(file); });
  if (files.empty()) {
    throw InputError(fmt::format("{}: found no files, expected clips", pattern));
  }
  return files;
}

std::string StemOf(const std::string& path) {
  std::string stem = fs::path(path).stem().string();
  for (char& c : stem) {
    if (static_cast<unsigned char>(c) <= ' ' || c == '\\') c = '_';
  }
  return stem;
}

struct Found {
  std::string a, b, posture, id;
};

// Of ids that are there twice, all get the names of the folders in front, then numbers.
void MakeUnique(std::vector<Found>* pairs) {
  const auto counts = [&] {
    std::map<std::string, int> count;
    for (const Found& pair : *pairs) ++count[pair.id];
    return count;
  };
  const std::map<std::string, int> by_stem = counts();
  for (Found& pair : *pairs) {
    if (by_stem.at(pair.id) == 1) continue;
    const std::string a = StemOf(fs::path(pair.a).parent_path().filename().string());
    const std::string b = StemOf(fs::path(pair.b).parent_path().filename().string());
    pair.id = fmt::format("{}{}{}{}{}", a, a.empty() ? "" : "-", b, b.empty() ? "" : "-", pair.id);
  }
  const std::map<std::string, int> by_folder = counts();
  std::map<std::string, int> seen;
  for (Found& pair : *pairs) {
    if (by_folder.at(pair.id) > 1) pair.id += fmt::format("-{}", ++seen[pair.id]);
  }
}

}  // namespace

std::string ManifestOfPatterns(const std::string& clips_a, const std::string& clips_b,
                               const std::vector<std::string>& templates, Pairing pairing) {
  const std::vector<std::string> all_a = FilesOf(clips_a), all_b = FilesOf(clips_b);
  std::vector<Found> pairs;
  for (const std::string& posture : templates) {
    for (const std::string& a : all_a) {
      for (const std::string& b : all_b) {
        const bool same = StemOf(a) == StemOf(b);
        if (pairing == Pairing::kName && !same) continue;
        std::string id = pairing == Pairing::kName ? StemOf(a) : StemOf(a) + "-" + StemOf(b);
        if (templates.size() > 1) id += "-" + StemOf(posture);
        pairs.push_back({a, b, posture, id});
      }
    }
  }
  if (pairs.empty()) {
    throw InputError(
        fmt::format("{} and {}: found no two clips that are called the same", clips_a, clips_b));
  }
  MakeUnique(&pairs);
  std::string csv = "id,clip_a,clip_b,template\n";
  const auto cell = [](const std::string& path) { return io::CsvCell(fs::absolute(path)); };
  for (const Found& pair : pairs) {
    csv += fmt::format("{},{},{},{}\n", io::CsvCell(pair.id), cell(pair.a), cell(pair.b),
                       cell(pair.posture));
  }
  return csv;
}

}  // namespace retarget::batch
