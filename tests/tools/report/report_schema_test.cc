// docs/report.md against real reports: every key that is written is described, and the other way
// round.
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#if __has_include(<valijson/validator.hpp>)
#define RETARGET_HAS_VALIJSON
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>
#endif

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

// Of runs that meet every requirement and that miss some.
std::vector<std::string> RealReports() {
  const Scratch scratch;
  std::vector<std::string> reports;
  for (const char* arguments :
       {" --frames 0:12", " --frames 0:12 --set weights.hold=0.1",
        " --frames 0:12 --set requirements.penetration_m=0 --set requirements.gli=0.9 "
        "--set requirements.write_back_m=0 --set requirements.floor_m=0"}) {
    reports.push_back(
        RunProgram(scratch, kExample + " --json --out " + (scratch / "out") + arguments).out);
  }
  return reports;
}

std::set<std::string> RealKeys() {
  std::set<std::string> keys;
  for (const std::string& report : RealReports()) CollectKeys(Json::parse(report), "", &keys);
  // What the example does not show, by the functions that write it: a pass-through, a hold to the
  // world.
  const solver::Scene scene = solver::SmallScene(4, 0.1);
  const solver::MetricsContext subject = solver::MetricsContextOf(scene);
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

TEST(ReportSchema, RealReportsFollowTheJsonSchema) {
#ifdef RETARGET_HAS_VALIJSON
  const nlohmann::json text =
      nlohmann::json::parse(ReadWholeFile(ProjectPath("docs/report.schema.json")));
  valijson::Schema schema;
  valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(text), schema);
  const auto complaints = [&](const nlohmann::json& report) {
    valijson::Validator validator;
    valijson::ValidationResults results;
    std::string out;
    if (validator.validate(schema, valijson::adapters::NlohmannJsonAdapter(report), &results)) {
      return out;
    }
    valijson::ValidationResults::Error error;
    while (results.popError(error)) {
      for (const std::string& part : error.context) out += part;
      out += ": " + error.description + "\n";
    }
    return out.empty() ? std::string("refused") : out;
  };
  nlohmann::json report;
  size_t missed = 0;
  for (const std::string& real : RealReports()) {
    report = nlohmann::json::parse(real);
    EXPECT_EQ(complaints(report), "");
    missed += report.at("conflicts").size();
  }
  EXPECT_GE(missed, 3u);
  // Every required key is one that a report may not lack, and every kind is one that it knows.
  for (const auto& [key, value] : report.items()) {
    nlohmann::json lacking = report;
    lacking.erase(key);
    EXPECT_NE(complaints(lacking), "") << "without " << key;
  }
  for (const auto& [pointer, bad] : {std::pair<const char*, nlohmann::json>{"/format", 2},
                                     {"/requirements/0/kind", "tangles"},
                                     {"/requirements/0/frame", -1},
                                     {"/requirements/0/figure", "c"},
                                     {"/frames", "90"},
                                     {"/metrics/result/a/floor_m", nullptr},
                                     {"/conflicts/0/cause", "bad luck"}}) {
    nlohmann::json wrong = report;
    wrong[nlohmann::json::json_pointer(pointer)] = bad;
    EXPECT_NE(complaints(wrong), "") << pointer;
  }
#else
  GTEST_SKIP() << "built without valijson (libvalijson-dev)";
#endif
}

// A report with the body's nodes is read back to the same subject; one without is of the standard
// body.
TEST(ReportSchema, TheSubjectIsReadBack) {
  const solver::Scene scene = solver::SmallScene(6, 0.1);
  const solver::MetricsContext subject = solver::MetricsContextOf(scene);
  const solver::MotionView motion = solver::ViewOf(scene.body, scene.source);
  const Json json = SubjectJson(subject, solver::Measure(subject, motion, motion));
  Json old = json;
  for (const char* figure : {"a", "b"}) old["bodies"][figure].erase("nodes");
  for (const Json& report : {json, old}) {
    const solver::MetricsContext read = SubjectFromJson(report, "r.json");
    for (int f = 0; f < 2; ++f) {
      ASSERT_EQ(read.body[f].num_nodes(), subject.body[f].num_nodes());
      for (int n = 0; n < subject.body[f].num_nodes(); ++n) {
        const Node &x = read.body[f].nodes[n], &y = subject.body[f].nodes[n];
        EXPECT_EQ(x.name, y.name);
        EXPECT_EQ(x.parent, y.parent);
        EXPECT_EQ(x.radius, y.radius);
        EXPECT_EQ(read.body[f].links[x.link].name, subject.body[f].links[y.link].name);
      }
      EXPECT_EQ(read.length[f], subject.length[f]);
    }
    EXPECT_EQ(read.tangles.size(), subject.tangles.size());
    EXPECT_EQ(read.holds.size(), subject.holds.size());
  }
  // Another body: a finger more.
  Json longer = json;
  longer["bodies"]["a"]["nodes"].push_back(
      {{"name", "left_finger"}, {"parent", "left_hand"}, {"link", "left_finger"}});
  longer["bodies"]["a"]["radius"]["left_finger"] = 0.01;
  longer["bodies"]["a"]["length"]["left_finger"] = 0.04;
  const solver::MetricsContext grown = SubjectFromJson(longer, "r.json");
  EXPECT_EQ(grown.body[0].num_nodes(), subject.body[0].num_nodes() + 1);
  EXPECT_EQ(grown.length[0].back(), 0.04);
  EXPECT_EQ(solver::TrackedJoints(grown.body[0]).size(),
            solver::TrackedJoints(subject.body[0]).size() + 1);
  Json astray = json;
  astray["holds"][0]["from"]["node"] = "tail";
  EXPECT_THROW(SubjectFromJson(astray, "r.json"), InputError);
}

}  // namespace
}  // namespace retarget::report
