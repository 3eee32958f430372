// Where tests find files that do not belong to the repository, and how they skip without them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace retarget {

// A file or folder of the shared reference data that stands beside a developer's checkout
// (RETARGET_SHARED_DIR, set by CMake; `../shared` by default).
inline std::string SharedPath(const std::string& relative) {
  return std::string(RETARGET_SHARED_DIR) + "/" + relative;
}

// A file of the repository itself.
inline std::string ProjectPath(const std::string& relative) {
  return std::string(RETARGET_SOURCE_DIR) + "/" + relative;
}

inline std::string ReadWholeFile(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace retarget

// Skips (CTest counts it) where the shared reference data are not there.
#define SKIP_WITHOUT_SHARED_DATA()                                          \
  if (!std::filesystem::exists(retarget::SharedPath("golden/README.md"))) { \
    GTEST_SKIP() << "no shared reference data at " << RETARGET_SHARED_DIR;  \
  }
