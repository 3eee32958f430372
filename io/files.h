// Files of a run: whole or not at all, and nothing of the user's lost.
#pragma once

#include <string>
#include <vector>

namespace retarget::io {

// FNV-1a of the bytes, 64 bits in hexadecimal: tells inputs apart, no more.
std::string HashOf(const std::string& bytes);

// Files that are written together: to temporary names first, then renamed.
class OutputSet {
 public:
  // Creates the folder. Throws InputError where it cannot, where a file to be written is one of
  // `inputs`, or where a file of one of `names` is there that no earlier run wrote (no report.json
  // of ours beside it) and `force` is not set.
  OutputSet(const std::string& folder, const std::vector<std::string>& names,
            const std::vector<std::string>& inputs, bool force);
  void Add(const std::string& name, std::string bytes);
  void Commit();

 private:
  std::string folder_;
  std::vector<std::pair<std::string, std::string>> files_;
};

// One file, the same way; refuses to overwrite unless `force`.
void WriteFile(const std::string& path, const std::string& bytes, bool force);

}  // namespace retarget::io
