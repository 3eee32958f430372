// The house keeps its order: which folder may know which, where each library lives, how large a
// folder may grow. Read from the sources themselves.
#include <algorithm>
#include <map>
#include <regex>
#include <set>

#include "tests/test_data.h"

namespace retarget {
namespace {

namespace fs = std::filesystem;

using Names = std::set<std::string>;

struct SourceFile {
  std::string path, folder;          // from the top of the checkout
  std::vector<std::string> project;  // what it includes in quotes
  std::vector<std::string> library;  // and in angles
  bool is_header() const { return path.ends_with(".h"); }
};

const std::vector<SourceFile>& SourceFiles() {
  static const std::vector<SourceFile> files = [] {
    const std::regex include(R"((?:^|\n)#include ([<"])([^>"]+)[>"])");
    std::vector<SourceFile> found;
    for (const char* layer : {"model", "solver", "io", "tools"}) {
      fs::recursive_directory_iterator entries(ProjectPath(layer));
      for (auto entry = begin(entries); entry != end(entries); ++entry) {
        if (entry->path().filename() == "node_modules") entry.disable_recursion_pending();
        const std::string extension = entry->path().extension();
        if (extension != ".h" && extension != ".cc") continue;
        const fs::path path = fs::relative(entry->path(), RETARGET_SOURCE_DIR);
        SourceFile file{path, path.parent_path(), {}, {}};
        const std::string text = ReadWholeFile(entry->path());
        for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) {
          ((*it)[1] == "<" ? file.library : file.project).push_back((*it)[2]);
        }
        found.push_back(file);
      }
    }
    return found;
  }();
  return files;
}

std::string LayerOf(const std::string& path) { return path.substr(0, path.find('/')); }

// The folders of its own layer that a folder may know.
const std::map<std::string, Names>& KnownFolders() {
  static const std::map<std::string, Names> folders = {
      {"model/geometry", {}},
      {"model", {"model/geometry"}},
      {"model/body", {"model", "model/geometry"}},
      {"model/rig", {"model", "model/geometry", "model/body"}},

      {"solver/problem", {}},
      {"solver/problem/terms", {"solver/problem"}},
      {"solver/optimizer", {"solver/problem", "solver/problem/terms"}},
      {"solver/start", {"solver/problem", "solver/problem/terms", "solver/optimizer"}},
      {"solver/simulation", {"solver/problem", "solver/problem/terms", "solver/optimizer"}},
      {"solver/metrics", {"solver/problem", "solver/problem/terms", "solver/optimizer"}},
      {"solver/proof", {"solver/problem", "solver/metrics"}},
      {"solver",
       {"solver/problem", "solver/problem/terms", "solver/optimizer", "solver/start",
        "solver/simulation", "solver/metrics"}},

      {"io/text", {}},
      {"io/data", {}},
      {"io/bvh", {"io/text"}},
      {"io/acclaim", {"io/text"}},
      {"io/gltf", {"io/text", "io/bvh"}},  // one frame time for all formats: io/bvh/bvh.h
      {"io/playback", {"io/text"}},
      {"io/recognition", {"io/text", "io/bvh", "io/acclaim", "io/gltf"}},
      {"io/render", {}},
      {"io/scene", {"io/text", "io/bvh", "io/acclaim", "io/gltf", "io/render"}},
      {"io",
       {"io/text", "io/bvh", "io/acclaim", "io/gltf", "io/playback", "io/recognition", "io/render",
        "io/scene"}},

      {"tools/report", {}},
      {"tools/proof", {"tools/report"}},
      {"tools/api", {"tools/report", "tools/proof"}},
      {"tools/posing", {"tools/report", "tools/api"}},
      {"tools/studio", {"tools/report", "tools/api", "tools/posing"}},
      {"tools/batch", {"tools/report", "tools/api", "tools/studio"}},
      {"tools/python", {"tools/report", "tools/api"}},
      {"tools/cli", {"tools/report", "tools/proof", "tools/api", "tools/posing", "tools/studio"}},
      {"tools/cli/batch", {"tools/report", "tools/api", "tools/batch", "tools/cli"}},
      {"tools/cli/proof", {"tools/report", "tools/proof", "tools/api", "tools/cli"}},
      {"tools/examples/embed", {}},
      {"tools/bench", {"tools/report", "tools/api", "tools/posing", "tools/studio"}}};
  return folders;
}

// Of other layers a folder may know all that is here.
const std::map<std::string, Names>& KnownLayers() {
  static const std::map<std::string, Names> layers = {{"model", {}},
                                                      {"solver", {"model"}},
                                                      {"io", {"model"}},
                                                      {"tools", {"model", "solver", "io"}}};
  return layers;
}

TEST(House, IncludesFollowTheFolders) {
  int checked = 0;
  for (const SourceFile& file : SourceFiles()) {
    ASSERT_TRUE(KnownFolders().count(file.folder)) << file.folder << " has no place in the order";
    for (const std::string& include : file.project) {
      const std::string target = fs::path(include).parent_path();
      ++checked;
      EXPECT_TRUE(fs::exists(ProjectPath(include))) << file.path << ": no file " << include;
      if (target == file.folder) continue;
      const bool allowed = LayerOf(target) == LayerOf(file.folder)
                               ? KnownFolders().at(file.folder).count(target) > 0
                               : KnownLayers().at(LayerOf(file.folder)).count(LayerOf(target)) > 0;
      EXPECT_TRUE(allowed) << file.path << " may not include " << include;
    }
  }
  EXPECT_GT(checked, 500);
}

// The sources alone, whatever the table above allows.
TEST(House, NoFolderIncludesItselfThroughOthers) {
  std::map<std::string, Names> includes;
  for (const SourceFile& file : SourceFiles()) {
    Names& targets = includes[file.folder];
    for (const std::string& include : file.project) {
      const std::string target = fs::path(include).parent_path();
      if (target != file.folder) {
        targets.insert(target);
      }
    }
  }
  // Takes away, again and again, what includes nothing that is left.
  for (bool changed = true; changed;) {
    changed = false;
    for (auto it = includes.begin(); it != includes.end();) {
      const bool free = std::none_of(it->second.begin(), it->second.end(),
                                     [&](const auto& name) { return includes.count(name) > 0; });
      changed |= free;
      it = free ? includes.erase(it) : std::next(it);
    }
  }
  for (const auto& [folder, targets] : includes) {
    ADD_FAILURE() << folder
                  << " is in a cycle, or includes one: " << testing::PrintToString(targets);
  }
}

TEST(House, AFolderHasAtMostTwentyUnits) {
  std::map<std::string, Names> units;  // a header and its source are one
  for (const SourceFile& file : SourceFiles()) {
    units[file.folder].insert(fs::path(file.path).stem());
  }
  for (const auto& entry : fs::recursive_directory_iterator(ProjectPath("tools/web/src"))) {
    if (entry.path().extension() != ".ts") continue;
    units[entry.path().parent_path()].insert(entry.path().stem());
  }
  EXPECT_GT(units.size(), 25u);
  for (const auto& [folder, names] : units) EXPECT_LE(names.size(), 20u) << folder;
}

struct Library {
  std::string include;  // what its headers begin with
  Names folders;        // layers or folders whose sources may use it
  Names headers;        // the project's headers that may
  int most_files;       // that use it
};

constexpr int kAnyNumber = 1000;

const std::vector<Library>& Libraries() {
  static const std::vector<Library> libraries = {
      {"ceres/", {"solver/optimizer"}, {}, 1},
      {"mujoco/", {"solver/simulation"}, {}, 1},
      {"tiny_gltf.h", {"io/gltf", "io/scene"}, {"io/gltf/load.h"}, 2},
      {"glm/", {"io/scene"}, {}, 1},
      {"yaml-cpp/", {"io/text"}, {}, 1},
      {"png.h", {"io/render"}, {}, 1},
      {"openssl/", {"io"}, {}, 1},
      {"stb/", {"io/render"}, {}, 1},
      {"CLI/", {"tools/cli"}, {}, 5},
      {"retarget/retarget.h", {"tools/examples"}, {}, kAnyNumber},  // as users include it
      {"pybind11/",
       {"tools/python"},
       {"tools/python/arrays.h", "tools/python/request.h"},
       kAnyNumber},
      {"httplib.h", {"tools/studio", "tools/bench"}, {}, 2},
      {"benchmark/", {"tools/bench"}, {}, kAnyNumber},
      {"nlohmann/",
       {"io", "tools"},
       {"io/text/message.h", "io/gltf/copy.h", "io/gltf/check.h", "tools/report/report.h"},
       kAnyNumber},
      {"fmt/", {"io", "tools"}, {"tools/posing/value.h"}, kAnyNumber},
      // Files, processes and random numbers of POSIX.
      {"sys/", {"tools"}, {"tools/studio/child_process.h", "tools/bench/in_child.h"}, kAnyNumber},
      {"unistd.h", {"io", "tools"}, {"tools/bench/in_child.h"}, kAnyNumber},
      {"fcntl.h", {"tools"}, {}, 1},
      {"glob.h", {"tools/batch"}, {}, 1},
      {"spawn.h", {"tools"}, {}, 1},
      {"time.h", {"tools"}, {}, 2}};
  return libraries;
}

bool IsIn(const std::string& folder, const Names& folders) {
  return std::any_of(folders.begin(), folders.end(), [&](const std::string& name) {
    return folder == name || folder.starts_with(name + "/");
  });
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
  const std::regex standard("[a-z_]+"), eigen("Eigen/[A-Za-z]+");
  std::map<std::string, Names> users;
  for (const SourceFile& file : SourceFiles()) {
    for (const std::string& include : file.library) {
      if (std::regex_match(include, standard) || std::regex_match(include, eigen)) continue;
      const auto library =
          std::find_if(Libraries().begin(), Libraries().end(),
                       [&](const Library& l) { return include.starts_with(l.include); });
      ASSERT_NE(library, Libraries().end()) << file.path << ": unknown library " << include;
      users[library->include].insert(file.path);
      EXPECT_TRUE(IsIn(file.folder, library->folders)) << file.path << " uses " << include;
      EXPECT_TRUE(!file.is_header() || library->headers.count(file.path))
          << file.path << ", a header, lets everybody see " << include;
    }
  }
  for (const Library& library : Libraries()) {
    EXPECT_GE(users[library.include].size(), 1u) << library.include << " is used no more";
    EXPECT_LE(static_cast<int>(users[library.include].size()), library.most_files)
        << library.include;
  }
}

}  // namespace
}  // namespace retarget
