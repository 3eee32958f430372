// `retarget compare` on finished runs.
#include <nlohmann/json.hpp>

#include "tests/tools/run_program.h"

namespace retarget::cli {
namespace {

using Json = nlohmann::json;

// Words of the first line of `text` that begins with `name`.
std::vector<std::string> Line(const std::string& text, const std::string& name) {
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line)) {
    if (line.rfind(name, 0) != 0) continue;
    std::istringstream words(line.substr(name.size()));
    return {std::istream_iterator<std::string>(words), {}};
  }
  return {};
}

class Compare : public testing::Test {
 protected:
  void SetUp() override {
    RunProgram(scratch_, kExample + " --frames 0:15 --out " + one_);
    RunProgram(scratch_, kExample + " --frames 0:12 --set weights.hold=0.1 --out " + two_);
    ASSERT_TRUE(fs::exists(one_ + "/report.json"));
    ASSERT_TRUE(fs::exists(two_ + "/report.json"));
  }
  Json Report(const std::string& folder) const {
    return Json::parse(ReadWholeFile(folder + "/report.json"));
  }
  void Rewrite(const std::string& folder, const Json& report) const {
    std::ofstream(folder + "/report.json") << report.dump(1);
  }

  const Scratch scratch_;
  const std::string one_ = scratch_ / "one", two_ = scratch_ / "two";
};

TEST_F(Compare, ShowsRunsSideBySideAndWhatDiffers) {
  const Outcome text = RunProgram(scratch_, "compare " + one_ + " " + two_);
  ASSERT_EQ(text.code, 0) << text.err;
  EXPECT_EQ(text.out.rfind("note: ", 0), 0u) << text.out;  // other frames: not one scene
  EXPECT_EQ(Line(text.out, " "), (std::vector<std::string>{"baseline", one_, two_}));
  const std::vector<std::string> hold = Line(text.out, "hold error, cm");
  ASSERT_EQ(hold.size(), 3u);
  EXPECT_FALSE(hold[1].ends_with('*'));
  EXPECT_TRUE(hold[2].ends_with('*'));
  EXPECT_EQ(Line(text.out, "  weights.hold"), (std::vector<std::string>{"60", "0.1"}));
  EXPECT_EQ(Line(text.out, "  frames.1"), (std::vector<std::string>{"15", "12"}));
  EXPECT_EQ(Line(text.out, "natural cost, hold").size(), 2u);

  const Json json = Json::parse(RunProgram(scratch_, "compare --json " + one_ + " " + two_).out);
  EXPECT_EQ(json["differences"].size(), 2u) << json["differences"];
  EXPECT_EQ(json["notes"].size(), 1u);
  EXPECT_EQ(json["baseline"], Report(one_)["metrics"]["baseline"]);
  for (int k = 0; k < 2; ++k) {
    const Json report = Report(k == 0 ? one_ : two_);
    EXPECT_EQ(json["runs"][k]["metrics"], report["metrics"]["result"]);
    EXPECT_EQ(json["runs"][k]["cost"], report["solve"]["cost"]);
  }
  // A run against itself differs in nothing.
  const Json same = Json::parse(RunProgram(scratch_, "compare --json " + one_ + " " + one_).out);
  EXPECT_TRUE(same["differences"].empty() && same["notes"].empty());
}

// A weight whose term costs nothing in any run, and one whose term does in one.
TEST_F(Compare, SaysWhichDifferingWeightsHadNothingToDo) {
  const auto with = [&](const std::string& folder, double weight, double cost) {
    Json report = Report(one_);
    report["configuration"]["weights"]["tangle"] = weight;
    for (Json& term : report["solve"]["terms"]) {
      if (term["term"] == "tangle") term["cost"] = term["natural_cost"] = cost;
    }
    Rewrite(folder, report);
  };
  const std::string note = "weights.tangle had nothing to do";
  with(two_, 200, 0);
  with(one_, 20, 0);
  EXPECT_EQ(RunProgram(scratch_, "compare " + one_ + " " + two_).out.rfind("note: " + note, 0), 0u);
  with(one_, 20, 0.1 * Report(one_)["solve"]["cost"].get<double>());
  EXPECT_EQ(RunProgram(scratch_, "compare " + one_ + " " + two_).out.find(note), std::string::npos);
  // Nor is it said of weights that are the same.
  with(one_, 200, 0);
  EXPECT_EQ(RunProgram(scratch_, "compare " + one_ + " " + two_).out.find(note), std::string::npos);
}

TEST_F(Compare, TheBaselineIsTheFirstRunsAndMayBeMissing) {
  Json report = Report(one_);
  report["metrics"]["baseline"] = nullptr;
  Rewrite(one_, report);
  EXPECT_EQ(Line(RunProgram(scratch_, "compare " + one_ + " " + two_).out, " "),
            (std::vector<std::string>{one_, two_}));
  report["metrics"]["baseline"] = report["metrics"]["source"];
  report["metrics"]["baseline"]["hold_m"] = {0.5};
  Rewrite(one_, report);
  const Outcome text = RunProgram(scratch_, "compare " + one_ + " " + two_);
  EXPECT_EQ(Line(text.out, " "), (std::vector<std::string>{"baseline", one_, two_}));
  ASSERT_EQ(Line(text.out, "hold error, cm").size(), 3u);
  EXPECT_EQ(Line(text.out, "hold error, cm")[0], "50.00*");
}

// Reports from before requirements had kinds show the same limits.
TEST_F(Compare, OldReportsAreRead) {
  const std::string now = RunProgram(scratch_, "compare " + one_ + " " + two_).out;
  EXPECT_FALSE(Line(now, "foot drift b, cm").empty());
  for (const std::string& folder : {one_, two_}) {
    Json report = Report(folder);
    for (Json& requirement : report["requirements"]) {
      for (const char* key : {"kind", "item", "figure", "frame", "limbs"}) requirement.erase(key);
    }
    for (const char* figure : {"a", "b"}) report["bodies"][figure].erase("nodes");
    Rewrite(folder, report);
  }
  EXPECT_EQ(RunProgram(scratch_, "compare " + one_ + " " + two_).out, now);
}

TEST_F(Compare, DamagedReportsGiveOneLineAndExitCode2) {
  std::vector<std::string> damaged = {"", "x", "[1]", "{\"solve\": 3}"};
  for (const char* key : {"inputs", "configuration", "metrics", "solve", "requirements"}) {
    for (const Json& value : {Json(3), Json("text"), Json::object(), Json::array({1})}) {
      Json report = Report(two_);
      report[key] = value;
      damaged.push_back(report.dump());
    }
  }
  int refused = 0;
  for (const std::string& text : damaged) {
    std::ofstream(two_ + "/report.json") << text;
    const Outcome run = RunProgram(scratch_, "compare " + one_ + " " + two_);
    EXPECT_TRUE(run.code == 0 || run.code == 2) << run.code << "\n" << text.substr(0, 200);
    if (run.code == 0) continue;  // an empty configuration differs, no more
    ++refused;
    EXPECT_NE(run.err.find(two_ + "/report.json"), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  EXPECT_GE(refused, 16);
  EXPECT_EQ(RunProgram(scratch_, "compare " + (scratch_ / "nowhere")).code, 2);
}

}  // namespace
}  // namespace retarget::cli
