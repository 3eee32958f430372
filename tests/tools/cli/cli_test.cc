// The program as a user meets it: exit codes, messages, files.
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/tools/run_program.h"

namespace retarget::cli {
namespace {

using Json = nlohmann::json;

int Lines(const std::string& text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

TEST(Cli, BadUsageAndInputGiveOneLineAndExitCode2) {
  const Scratch scratch;
  const std::string not_bvh = scratch.Write("x.bvh", "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0\n");
  const std::string bad_config = scratch.Write("c.yaml", "weights:\n  tangel: 3\n");
  const std::string out = " --out " + (scratch / "out");
  const struct {
    std::string arguments, expected;
  } cases[] = {
      {"", "--clip-a is missing"},
      {"--no-such-option", "--no-such-option"},
      {kExample + " --frames 5:2" + out, "--frames 5:2: expected i:j"},
      {kExample + " --frames 0:99999" + out, "common output frames"},
      {kExample + " --template-at 1000" + out, "--template-at 1000"},
      {kExample + " --start-a 1000" + out, "--start-a 1000"},
      {kExample + " --units-a parsec" + out, "--units-a parsec: expected"},
      {kExample + " --stature-b 9" + out, "--stature-b"},
      {kExample + " --set weights.tangel=3" + out, "did you mean \"weights.tangle\""},
      {kExample + " --set solve.stages=banana" + out, "solve.stages"},
      {kExample + " --config " + bad_config + out, "c.yaml:2"},
      {kExample + " --config /nowhere/c.yaml" + out, "/nowhere/c.yaml"},
      {"--clip-a " + not_bvh + " --clip-b " + kHold + "/b.bvh --template " + kHold +
           "/template.yaml" + out,
       "x.bvh:5"},
      {"map " + not_bvh, "x.bvh:5"},
      {"map /nowhere.bvh", "/nowhere.bvh"},
      {"map " + kHold, "is a folder"},
      {"tangles /nowhere.yaml", "/nowhere.yaml"},
      {"tangles " + scratch.Write("p.json", "{\"A\": [[1,2]]}"), "\"A\""},
      {"verify " + (scratch / "nothing"), "report.json"},
      {"template --from-clips " + kHold + "/a.bvh " + kHold + "/b.bvh --frame 9999 --out " +
           (scratch / "t.yaml"),
       "--frame 9999"},
      {"template", "expected --check"},
  };
  for (const auto& c : cases) {
    const Outcome outcome = RunProgram(scratch, c.arguments);
    EXPECT_EQ(outcome.code, 2) << c.arguments << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(c.expected), std::string::npos) << c.arguments << "\n"
                                                               << outcome.err;
    EXPECT_EQ(Lines(outcome.err), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "") << c.arguments;
    EXPECT_FALSE(fs::exists(scratch / "out")) << c.arguments;
  }
}

TEST(Cli, RetargetsTheExampleVerifiesItAndNoticesDamage) {
  const Scratch scratch;
  const std::string folder = scratch / "out";
  const Outcome run = RunProgram(scratch, kExample + " --frames 0:90 --json --out " + folder);
  ASSERT_EQ(run.code, 0) << run.err;
  const Json report = Json::parse(run.out);
  for (const char* key :
       {"tangles", "pass_throughs", "bodies", "contacts", "supports", "holds", "placement",
        "metrics", "timings", "memory", "iterations", "versions", "inputs", "configuration",
        "requirements", "warnings", "simulation", "start"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(report["frames"], 90);
  EXPECT_EQ(report["pass_throughs"].size(), 0u);
  ASSERT_GE(report["tangles"].size(), 1u);
  bool arms_round_trunk = false;
  for (const Json& t : report["tangles"]) {
    EXPECT_GT(t["min_signed_gli"], 0.5);
    EXPECT_EQ(t["frames_below_half"], 0);
    const auto arm = [](const std::string& n) {
      return n.ends_with("hand") || n.ends_with("wrist");
    };
    arms_round_trunk |= arm(t["a"][0]) && arm(t["a"][1]);
  }
  EXPECT_TRUE(arms_round_trunk);
  EXPECT_EQ(report["bodies"]["a"]["radius"].size(), 20u);
  EXPECT_EQ(report["bodies"]["b"]["length"].size(), 20u);
  for (const char* figure : {"a", "b"}) EXPECT_GT(report["contacts"][figure].size(), 0u);

  const Outcome verified = RunProgram(scratch, "verify --json " + folder);
  EXPECT_EQ(verified.code, 0) << verified.out;
  const Json again = Json::parse(verified.out);
  EXPECT_NEAR(again["metrics"]["result"]["smallest_gli"],
              report["metrics"]["result"]["smallest_gli"].get<double>(), 1e-9);

  EXPECT_NEAR(again["metrics"]["baseline"]["smallest_gli"],
              report["metrics"]["baseline"]["smallest_gli"].get<double>(), 1e-9);
  EXPECT_EQ(report["simulation"]["status"], "completed");
  EXPECT_EQ(report["start"]["used"], "simulated");
  EXPECT_NE(RunProgram(scratch, "verify " + folder).out.find("baseline"), std::string::npos);
  EXPECT_NE(ReadWholeFile(folder + "/report.html").find("<html"), std::string::npos);

  // An older run has no simulated scene beside it.
  fs::remove(folder + "/baseline.glb");
  const Outcome two = RunProgram(scratch, "verify --json " + folder);
  EXPECT_EQ(two.code, 0) << two.out;
  EXPECT_TRUE(Json::parse(two.out)["metrics"]["baseline"].is_null());

  // The effective configuration repeats the run, byte for byte.
  const Outcome repeated = RunProgram(scratch, kExample + " --frames 0:90 --config " + folder +
                                                   "/config.yaml --out " + (scratch / "again"));
  EXPECT_EQ(repeated.code, 0) << repeated.err;
  EXPECT_EQ(ReadWholeFile(folder + "/scene.glb"), ReadWholeFile(scratch / "again/scene.glb"));
  EXPECT_EQ(ReadWholeFile(folder + "/a.bvh"), ReadWholeFile(scratch / "again/a.bvh"));
  EXPECT_EQ(ReadWholeFile(folder + "/config.yaml"), ReadWholeFile(scratch / "again/config.yaml"));

  // The source in the result's place is no solution, and verify says so.
  fs::copy_file(folder + "/source.glb", folder + "/scene.glb",
                fs::copy_options::overwrite_existing);
  const Outcome missed = RunProgram(scratch, "verify " + folder);
  EXPECT_EQ(missed.code, 3);
  EXPECT_NE(missed.out.find("MISSED"), std::string::npos);
  std::ofstream(folder + "/scene.glb", std::ios::binary) << "glTF";
  EXPECT_EQ(RunProgram(scratch, "verify " + folder).code, 2);
}

TEST(Cli, SimulateWritesTheBaselineThatRetargetHas) {
  const Scratch scratch;
  const Outcome run = RunProgram(
      scratch, "simulate " + kExample + " --frames 0:45 --json --out " + (scratch / "s"));
  ASSERT_EQ(run.code, 0) << run.err;
  const Json report = Json::parse(run.out);
  EXPECT_EQ(report["simulation"]["status"], "completed");
  EXPECT_GT(report["simulation"]["settle_s"], 0);
  EXPECT_EQ(RunProgram(scratch, kExample + " --frames 0:45 --out " + (scratch / "r")).code, 0);
  EXPECT_EQ(ReadWholeFile(scratch / "s/baseline.glb"), ReadWholeFile(scratch / "r/baseline.glb"));
  EXPECT_EQ(RunProgram(scratch, "simulate --clip-a x.bvh").code, 2);
  // Another kind of tangle force is another run; an unknown one is refused.
  EXPECT_EQ(RunProgram(scratch, "simulate " + kExample + " --frames 0:45 --out " + (scratch / "g") +
                                    " --set simulation.tangle_force=gli")
                .code,
            0);
  EXPECT_NE(ReadWholeFile(scratch / "s/baseline.glb"), ReadWholeFile(scratch / "g/baseline.glb"));
  const Outcome unknown = RunProgram(scratch, "simulate " + kExample + " --out " + (scratch / "u") +
                                                  " --set simulation.tangle_force=rubber");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("elastic"), std::string::npos) << unknown.err;
}

TEST(Cli, LimitsGiveExitCode4AndTheBestSoFar) {
  const Scratch scratch;
  const Outcome run = RunProgram(
      scratch, kExample + " --frames 0:40 --set solve.max_iterations=1 --out " + (scratch / "out"));
  EXPECT_EQ(run.code, 4) << run.err;
  EXPECT_TRUE(fs::exists(scratch / "out/scene.glb"));
}

TEST(Cli, MissedRequirementsGiveExitCode3) {
  const Scratch scratch;
  const Outcome run = RunProgram(
      scratch, kExample + " --frames 0:40 --set requirements.gli=1.5 --out " + (scratch / "out"));
  EXPECT_EQ(run.code, 3) << run.err;
  EXPECT_NE(run.out.find("MISSED tangle 1"), std::string::npos);
}

TEST(Cli, NothingOfTheUsersIsOverwritten) {
  const Scratch scratch;
  const std::string a = scratch.Write("a.bvh", ReadWholeFile(kHold + "/a.bvh"));
  const std::string arguments = "--clip-a " + a + " --clip-b " + kHold + "/b.bvh --template " +
                                kHold + "/template.yaml --frames 0:10 --out " + (scratch / "");
  EXPECT_EQ(RunProgram(scratch, arguments).code, 2);
  EXPECT_EQ(RunProgram(scratch, arguments + " --force").code, 2);  // not even then: it is an input
  EXPECT_EQ(ReadWholeFile(a), ReadWholeFile(kHold + "/a.bvh"));
  fs::create_directory(scratch / "out");
  const std::string other = scratch.Write("out/b.bvh", "mine");
  EXPECT_EQ(RunProgram(scratch, kExample + " --frames 0:10 --out " + (scratch / "out")).code, 2);
  EXPECT_EQ(ReadWholeFile(other), "mine");
  EXPECT_FALSE(fs::exists(scratch / "out/scene.glb"));
}

TEST(Cli, TanglesMapConfigAndTemplate) {
  const Scratch scratch;
  const Json tangles =
      Json::parse(RunProgram(scratch, "tangles --json " + kHold + "/template.yaml").out);
  EXPECT_GT(tangles["literal"].size(), tangles["tags"].size());
  EXPECT_TRUE(tangles["tags"][0].contains("rho"));
  const Json map = Json::parse(RunProgram(scratch, "map --json " + kHold + "/a.bvh").out);
  EXPECT_EQ(map["joints"]["left_knee"], "LeftLeg");
  EXPECT_EQ(map["frames"], 301);
  EXPECT_NEAR(map["stature_m"], 1.82, 0.02);
  const Outcome config = RunProgram(scratch, "config --set weights.tangle=7");
  EXPECT_NE(config.out.find("tangle: 7"), std::string::npos);
  EXPECT_EQ(RunProgram(scratch, "template --check " + kHold + "/template.yaml").code, 0);
  const std::string made = scratch / "made.yaml";
  const std::string make =
      "template --from-clips " + kHold + "/a.bvh " + kHold + "/b.bvh --frame 12 --out " + made;
  EXPECT_EQ(RunProgram(scratch, make).code, 0);
  EXPECT_EQ(RunProgram(scratch, make).code, 2);  // is there already
  EXPECT_NE(ReadWholeFile(made).find("lengths"), std::string::npos);
}

TEST(Cli, GoldenPosturesGiveTheirListsThroughTheCommandLine) {
  const Scratch scratch;
  int checked = 0;
  for (const Json& posture : Json::parse(ReadWholeFile(TestDataPath("golden/postures.json")))) {
    const Json positions = {{"A", posture["A"]}, {"B", posture["B"]}};
    const Outcome run =
        RunProgram(scratch, "tangles --json " + scratch.Write("p.json", positions.dump()));
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(Json::parse(run.out)["literal"].size(), posture["n_tangles"].get<size_t>());
    ++checked;
  }
  EXPECT_EQ(checked, 3);
}

TEST(Cli, TheValidatorAcceptsWhatIsWritten) {
  const char* modules = std::getenv("RETARGET_NODE_MODULES");
  if (!modules || std::system("command -v node >/dev/null") != 0) {
    GTEST_SKIP() << "no node, or RETARGET_NODE_MODULES is not set";
  }
  const Scratch scratch;
  ASSERT_EQ(RunProgram(scratch, kExample + " --frames 0:20 --out " + (scratch / "out")).code, 0);
  const std::string command = "node " + ProjectPath("tests/tools/validate_glb.mjs") + " " +
                              (scratch / "out/scene.glb") + " " + (scratch / "out/source.glb") +
                              " >" + (scratch / "v.json");
  const int status = std::system(command.c_str());
  if (WEXITSTATUS(status) == 3) GTEST_SKIP() << "gltf-validator is not installed";
  EXPECT_EQ(WEXITSTATUS(status), 0) << ReadWholeFile(scratch / "v.json");
}

}  // namespace
}  // namespace retarget::cli
