// What is said before the solve of clips that do not fit, and what would fit better.
#include <algorithm>

#include "tests/tools/run_program.h"
#include "tools/api/job.h"

namespace retarget::cli {
namespace {

api::Job JobOf(const std::string& a, const std::string& b, const std::string& hold,
               double template_at = 0) {
  Request request;
  request.clip[0].path = a;
  request.clip[1].path = b;
  request.clip[0].words.start = request.clip[1].words.start = "--start";
  request.clip[0].option = "a";
  request.clip[1].option = "b";
  request.template_path = ProjectPath("data/holds/" + hold + "/template.yaml");
  request.template_at = template_at;
  request.words.template_at = "--template-at";
  return api::LoadJob(request);
}
std::string Clip(const std::string& name) { return ProjectPath("data/holds/" + name); }

bool Says(const api::JobFit& fit, const std::string& text) {
  return std::any_of(fit.warnings.begin(), fit.warnings.end(),
                     [&](const std::string& w) { return w.find(text) != std::string::npos; });
}

TEST(ClipAdvice, ShippedClipsFitAndNothingIsSaid) {
  for (const std::string hold :
       {"argentine_backbreaker", "bear_hug", "fireman_carry", "full_nelson", "hug", "octopus_hold",
        "piggyback", "rear_choke", "supported_walk"}) {
    const api::JobFit fit = JobOf(Clip(hold + "/a.bvh"), Clip(hold + "/b.bvh"), hold).fit;
    EXPECT_TRUE(fit.figure[0].fits && fit.figure[1].fits) << hold;
    EXPECT_TRUE(fit.warnings.empty()) << hold << ": " << fit.warnings[0];
    EXPECT_FALSE(fit.mirrored_fits_better) << hold;
  }
}

TEST(ClipAdvice, WhatDiffersIsNamed) {
  const api::JobFit fit =
      JobOf(Clip("bear_hug/a.bvh"), Clip("argentine_backbreaker/b.bvh"), "bear_hug").fit;
  EXPECT_TRUE(fit.figure[0].fits);
  EXPECT_FALSE(fit.figure[1].fits);
  EXPECT_TRUE(Says(fit, "clip b lies where figure b stands"));
  EXPECT_TRUE(Says(fit, "no instant of it is clearly nearer"));
  const api::JobFit standing =
      JobOf(Clip("argentine_backbreaker/a.bvh"), Clip("bear_hug/b.bvh"), "argentine_backbreaker")
          .fit;
  EXPECT_TRUE(Says(standing, "clip b stands where figure b lies"));
}

TEST(ClipAdvice, MirroredClipsFitTheMirroredTemplate) {
  const Scratch scratch;
  const std::string hold = "supported_walk";
  for (const std::string f : {"a", "b"}) {
    ASSERT_EQ(RunProgram(scratch, "mirror " + Clip(hold + "/" + f + ".bvh") + " --out " +
                                      (scratch / (f + ".bvh")))
                  .code,
              0);
  }
  const api::JobFit fit = JobOf(scratch / "a.bvh", scratch / "b.bvh", hold).fit;
  EXPECT_TRUE(fit.mirrored_fits_better);
  EXPECT_TRUE(Says(fit, "--mirror both"));
}

// The clip holds still in the template's posture but for a second in which it lies down.
TEST(ClipAdvice, ABetterInstantIsNamedWithItsOption) {
  const api::Job good = JobOf(Clip("bear_hug/a.bvh"), Clip("bear_hug/b.bvh"), "bear_hug");
  solver::RetargetInput input = good.input;
  const Quat down(Eigen::AngleAxisd(80 * kDegree, Vec3::UnitX()));
  for (int t = 0; t < 30; ++t) {
    Pose& pose = input.clip[1].frames[t];
    pose.rotation[0] = pose.rotation[0] * down;
  }
  const api::JobFit fit = api::FitOfJob(input, good.clip, {}, 0, "--template-at");
  EXPECT_FALSE(fit.figure[1].fits);
  EXPECT_TRUE(Says(fit, "both clips are nearer to the template at "));
  EXPECT_TRUE(Says(fit, "--template-at "));
  EXPECT_TRUE(Says(fit, "--start-b 0.0"));  // the whole clip, as it is on disk, begins so
  EXPECT_GE(fit.figure[1].best_at_s, 1.0);
}

TEST(ClipAdvice, ARunTellsBeforeItSolvesAndReportsIt) {
  const Scratch scratch;
  const Outcome run = RunProgram(
      scratch,
      "--clip-a " + Clip("bear_hug/a.bvh") + " --clip-b " + Clip("argentine_backbreaker/b.bvh") +
          " --template " + ProjectPath("data/holds/bear_hug/template.yaml") +
          " --frames 0:12 --set solve.max_iterations=1 --progress json --out " + (scratch / "out"));
  const size_t told = run.err.find("warning: clip b lies where figure b stands");
  const size_t iteration = run.err.find("\"iteration\"");
  ASSERT_NE(told, std::string::npos) << run.err;
  ASSERT_NE(iteration, std::string::npos) << run.err;
  EXPECT_LT(told, iteration);
  EXPECT_EQ(run.err.find("warning: clip b lies", told + 10), std::string::npos) << "told twice";
  const report::Json report = report::Json::parse(ReadWholeFile(scratch / "out/report.json"));
  EXPECT_FALSE(report["clip_fit"]["b"]["fits"]);
  EXPECT_NE(ReadWholeFile(scratch / "out/report.html").find("lies where figure b stands"),
            std::string::npos);
}

}  // namespace
}  // namespace retarget::cli
