// Where tests find their files: those of the repository, and those that stand beside it, without
// which tests skip.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace retarget {

// A file or folder of the reference data of others, which stand beside a developer's checkout for
// their licences (RETARGET_SHARED_DIR, set by CMake; `../shared` by default).
inline std::string SharedPath(const std::string& relative) {
  return std::string(RETARGET_SHARED_DIR) + "/" + relative;
}

// A file of the repository itself.
inline std::string ProjectPath(const std::string& relative) {
  return std::string(RETARGET_SOURCE_DIR) + "/" + relative;
}

// A file of the tests' own data, which every checkout has: a test that reads them never skips.
inline std::string TestDataPath(const std::string& relative) {
  return ProjectPath("tests/data/" + relative);
}

inline std::string ReadWholeFile(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace retarget

// Skips (CTest counts it) where the reference data of others are not there.
#define SKIP_WITHOUT_SHARED_DATA()                                         \
  if (!std::filesystem::exists(retarget::SharedPath("data/README.md"))) {  \
    GTEST_SKIP() << "no shared reference data at " << RETARGET_SHARED_DIR; \
  }
