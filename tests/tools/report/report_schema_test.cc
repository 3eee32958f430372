// docs/report.md against real reports: every key that is written is described, and the other way
// round.
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "tests/solver/scene_fixture.h"
#include "tests/tools/run_program.h"
#include "tools/report/report.h"
#include "tools/report/subject_json.h"

namespace retarget::report {
namespace {

// "x.{a,b}" -> "x.a", "x.b".
std::vector<std::string> Expanded(const std::string& pattern) {
  const size_t open = pattern.find('{');
  if (open == std::string::npos) return {pattern};
  const size_t close = pattern.find('}', open);
  std::vector<std::string> out;
  std::istringstream choices(pattern.substr(open + 1, close - open - 1));
  std::string choice;
  while (std::getline(choices, choice, ',')) {
    for (const std::string& rest : Expanded(pattern.substr(close + 1))) {
      out.push_back(pattern.substr(0, open) + choice + rest);
    }
  }
  return out;
}

// The keys in the first column of the first table of docs/report.md.
std::vector<std::string> DocumentedKeys() {
  std::istringstream text(ReadWholeFile(ProjectPath("docs/report.md")));
  std::vector<std::string> keys;
  std::string line;
  while (std::getline(text, line) && line.rfind("##", 0) != 0) {
    if (line.rfind("| `", 0) != 0) continue;
    const std::string column = line.substr(1, line.find(" | ", 1) - 1);
    const std::regex quoted("`([^`]+)`");
    for (std::sregex_iterator it(column.begin(), column.end(), quoted), end; it != end; ++it) {
      for (const std::string& key : Expanded((*it)[1])) keys.push_back(key);
    }
  }
  return keys;
}

// Paths of all leaves; an empty list is a leaf "x[]", null is a leaf "x?".
void CollectKeys(const Json& json, const std::string& path, std::set<std::string>* keys) {
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      CollectKeys(value, path.empty() ? key : path + "." + key, keys);
    }
  } else if (json.is_array()) {
    if (json.empty()) keys->insert(path + "[]");
    for (const Json& item : json) CollectKeys(item, path + "[]", keys);
  } else {
    keys->insert(path + (json.is_null() ? "?" : ""));
  }
}

// A list or object that is empty or absent in one report stands for all that it may hold.
bool StandsFor(const std::string& path, const std::string& key) {
  if (path.back() == '?') {
    const std::string base = path.substr(0, path.size() - 1);
    return key == base || key.rfind(base + ".", 0) == 0;
  }
  return path.ends_with("[]") && key.rfind(path + ".", 0) == 0;
}

std::string PatternOf(const std::string& key) {
  std::string out;
  for (const char c : key) {
    if (c == '*') {
      out += "[^\\[\\]]+";
    } else {
      out += std::string(c == '.' || c == '[' || c == ']' ? "\\" : "") + c;
    }
  }
  return out;
}

std::set<std::string> RealKeys() {
  const Scratch scratch;
  std::set<std::string> keys;
  for (const char* arguments : {" --frames 0:12", " --frames 0:12 --set weights.hold=0.1"}) {
    const Outcome run =
        RunProgram(scratch, kExample + " --json --out " + (scratch / "out") + arguments);
    CollectKeys(Json::parse(run.out), "", &keys);
  }
  // What the example does not show, by the functions that write it: a pass-through, a hold to the
  // world.
  const solver::Scene scene = solver::SmallScene(4, 0.1);
  const solver::MeasureSubject subject = solver::SubjectOf(scene);
  const solver::MotionView motion = solver::ViewOf(scene.body, scene.source);
  solver::Metrics metrics = solver::Measure(subject, motion, motion);
  metrics.pass_throughs = {{1, 2, 3}};
  CollectKeys(SubjectJson(subject, metrics), "", &keys);
  return keys;
}

TEST(ReportSchema, DocsAndRealReportsHaveTheSameKeys) {
  const std::vector<std::string> documented = DocumentedKeys();
  const std::set<std::string> real = RealKeys();
  EXPECT_GT(documented.size(), 150u);
  EXPECT_GT(real.size(), 250u);
  std::set<std::string> described;
  for (const std::string& key : documented) {
    const std::regex pattern(PatternOf(key));
    bool seen = false;
    for (const std::string& path : real) {
      const bool same = std::regex_match(path, pattern);
      if (same || StandsFor(path, key)) described.insert(path);
      seen = seen || same || (path.back() == '?' && StandsFor(path, key));
    }
    EXPECT_TRUE(seen) << "docs/report.md describes " << key << ", no report has it";
  }
  for (const std::string& path : real) {
    EXPECT_TRUE(described.count(path) > 0) << "docs/report.md does not describe " << path;
  }
}

}  // namespace
}  // namespace retarget::report
