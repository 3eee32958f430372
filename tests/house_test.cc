// The house keeps its order: model <- solver, model <- io, all <- tools; each big library in few
// files.
#include <map>
#include <regex>

#include "tests/test_data.h"

namespace retarget {
namespace {

namespace fs = std::filesystem;

TEST(House, IncludesFollowTheFolders) {
  const std::map<std::string, std::string> may_include = {{"model", "model"},
                                                          {"solver", "model|solver"},
                                                          {"io", "model|io"},
                                                          {"tools", "model|solver|io|tools"}};
  const std::regex include("#include \"(model|solver|io|tools|tests|data)/");
  int checked = 0;
  for (const auto& [folder, allowed] : may_include) {
    const std::regex good("^(" + allowed + ")$");
    for (const auto& entry : fs::recursive_directory_iterator(ProjectPath(folder))) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cc") continue;
      const std::string text = ReadWholeFile(entry.path());
      for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) {
        EXPECT_TRUE(std::regex_match((*it)[1].str(), good)) << entry.path() << ": " << it->str();
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 150);
}

// What the command line calls its options is known to the tools alone.
TEST(House, NoOptionIsNamedBelowTheTools) {
  const std::regex option("\"(?:[^\"\\\\\n]|\\\\.)*--[a-z]");
  EXPECT_TRUE(std::regex_search(std::string("f(\"give \\\"it\\\" with --units\")"), option));
  int checked = 0;
  for (const char* folder : {"model", "solver", "io"}) {
    for (const auto& entry : fs::recursive_directory_iterator(ProjectPath(folder))) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cc") continue;
      std::istringstream text(ReadWholeFile(entry.path()));
      std::string line;
      while (std::getline(text, line)) {
        if (line.find("#include") != std::string::npos) continue;
        EXPECT_FALSE(std::regex_search(line, option)) << entry.path() << ": " << line;
      }
      ++checked;
    }
  }
  EXPECT_GT(checked, 150);
}

TEST(House, EachLibraryLivesInFewFiles) {
  const struct {
    const char* include;
    const char* folder;  // the only one that may use it
    int most_files;
  } libraries[] = {{"#include <ceres/", "solver", 1},  {"#include <mujoco", "solver", 2},
                   {"#include <tiny_gltf", "io", 2},   {"#include <glm/", "io", 2},
                   {"#include <yaml-cpp", "io", 1},    {"#include <CLI/", "tools", 2},
                   {"#include <httplib.h", "tools", 2}};
  for (const auto& library : libraries) {
    std::vector<std::string> users;
    for (const char* folder : {"model", "solver", "io", "tools"}) {
      for (const auto& entry : fs::recursive_directory_iterator(ProjectPath(folder))) {
        if (!entry.is_regular_file()) continue;
        if (ReadWholeFile(entry.path()).find(library.include) == std::string::npos) continue;
        users.push_back(entry.path());
        EXPECT_STREQ(folder, library.folder) << entry.path();
      }
    }
    std::vector<std::string> files;
    for (const std::string& user : users) {
      const std::string stem = fs::path(user).stem();
      if (std::find(files.begin(), files.end(), stem) == files.end()) files.push_back(stem);
    }
    EXPECT_LE(static_cast<int>(files.size()), library.most_files) << library.include;
  }
}

}  // namespace
}  // namespace retarget
