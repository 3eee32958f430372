// Files of a run: whole or not at all, and nothing of the user's lost.
#pragma once

#include <string>
#include <vector>

#include "model/geometry/types.h"

namespace retarget::io {

// FNV-1a of the bytes, 64 bits in hexadecimal: tells inputs apart, no more.
std::string HashOf(const std::string& bytes);

// A file or folder that may not be written; what() says why.
class WriteRefusal : public InputError {
 public:
  enum class Kind {
    kFileExists,    // the file is there already, `force` would overwrite it
    kForeignFiles,  // the folder has files that no earlier run wrote, `force` would overwrite them
    kInput,         // the folder's file is one of the inputs
    kNoFolder       // the folder cannot be created
  };
  WriteRefusal(Kind kind, const std::string& path, const std::string& file);

  Kind kind() const { return kind_; }
  const std::string& path() const { return path_; }  // of the file, or of the folder
  const std::string& file() const { return file_; }  // in the folder; of kInput the input

 private:
  Kind kind_;
  std::string path_, file_;
};

// Files that are written together: to temporary names first, then renamed.
class OutputSet {
 public:
  // Creates the folder. Throws WriteRefusal where it cannot, where a file to be written is one of
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

// One file, the same way; throws WriteRefusal where it would overwrite without `force`.
void WriteFile(const std::string& path, const std::string& bytes, bool force);

}  // namespace retarget::io
