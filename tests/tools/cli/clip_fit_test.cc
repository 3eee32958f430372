// Clips that are given the wrong way round, twice, or for a template that they do not fit.
#include <algorithm>
#include <set>

#include "solver/retarget.h"
#include "tests/tools/run_program.h"
#include "tools/api/job.h"
#include "tools/report/report.h"

namespace retarget::cli {
namespace {

// What is said of the clips before the solve.
std::vector<std::string> Warnings(const std::string& a, const std::string& b,
                                  const std::string& hold) {
  Request request;
  request.clip[0].path = ProjectPath("data/holds/" + a);
  request.clip[1].path = ProjectPath("data/holds/" + b);
  request.template_path = ProjectPath("data/holds/" + hold + "/template.yaml");
  return solver::Prepare(api::LoadJob(request).input, request.settings).warnings;
}

bool Says(const std::vector<std::string>& warnings, const std::string& text) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const std::string& w) { return w.find(text) != std::string::npos; });
}

bool SaysAnyOfFit(const std::vector<std::string>& warnings) {
  return Says(warnings, "other way round") || Says(warnings, " fit") || Says(warnings, " same ");
}

TEST(ClipFit, ShippedHoldsAreRightAsTheyAreAndToldWhereTheyAreNot) {
  std::set<std::string> holds;
  for (const auto& entry : fs::directory_iterator(ProjectPath("data/holds"))) {
    if (entry.is_directory()) holds.insert(entry.path().filename());
  }
  EXPECT_GE(holds.size(), 9u);
  for (const std::string& hold : holds) {
    const std::string a = hold + "/a.bvh", b = hold + "/b.bvh";
    EXPECT_FALSE(SaysAnyOfFit(Warnings(a, b, hold))) << hold;
    EXPECT_TRUE(Says(Warnings(b, a, hold), "other way round: swap them")) << hold;
    EXPECT_TRUE(Says(Warnings(a, a, hold), "both clips are the same motion")) << hold;
  }
}

TEST(ClipFit, OneWhoLiesFitsNobodyWhoStands) {
  const std::vector<std::string> said =
      Warnings("bear_hug/a.bvh", "argentine_backbreaker/b.bvh", "bear_hug");
  EXPECT_TRUE(Says(said, "clip b fits no figure of the template"));
  EXPECT_FALSE(Says(said, "clip a "));
  // One who stands is no load, but would do as a carrier.
  EXPECT_TRUE(Says(Warnings("piggyback/a.bvh", "bear_hug/b.bvh", "piggyback"),
                   "clip b does not fit figure b"));
}

TEST(ClipFit, ARunSaysItEverywhere) {
  const Scratch scratch;
  const std::string swapped = "--clip-a " + kHold + "/b.bvh --clip-b " + kHold +
                              "/a.bvh --template " + kHold + "/template.yaml --frames 0:12";
  const std::string once = "--set solve.max_iterations=1 --out " + (scratch / "out");
  const Outcome run = RunProgram(scratch, swapped + " " + once);
  const std::string sentence = "clearly better the other way round";
  EXPECT_NE(run.err.find("warning: the clips fit the template " + sentence), std::string::npos)
      << run.err;
  const report::Json report = report::Json::parse(ReadWholeFile(scratch / "out/report.json"));
  EXPECT_TRUE(Says(report["warnings"].get<std::vector<std::string>>(), sentence));
  EXPECT_NE(ReadWholeFile(scratch / "out/report.html").find(sentence), std::string::npos);
  // One file from two instants is another motion, and still one performer.
  const Outcome twice = RunProgram(scratch, "--clip-a " + kHold + "/a.bvh --clip-b " + kHold +
                                                "/a.bvh --start-b 1 --template " + kHold +
                                                "/template.yaml --frames 0:12 --force " + once);
  EXPECT_NE(twice.err.find("warning: both clips are the same file, at different instants"),
            std::string::npos)
      << twice.err;
}

}  // namespace
}  // namespace retarget::cli
