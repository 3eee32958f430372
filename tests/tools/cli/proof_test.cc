// The proof of a run, its certificate, and scenes of other programs, as a user sees them.
#include <nlohmann/json.hpp>

#include "tests/tools/run_program.h"

namespace retarget::cli {
namespace {

using Json = nlohmann::json;

bool Has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class ProofCommands : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(RunProgram(scratch_, kExample + " --frames 0:12 --out " + run_).code, 0);
  }
  Json Read(const std::string& file) const { return Json::parse(ReadWholeFile(run_ + "/" + file)); }
  void Write(const std::string& file, const Json& json) const {
    std::ofstream(run_ + "/" + file) << json.dump(1);
  }
  // What is wrong with the certificate of a copy of the run after a change.
  template <typename Change>
  std::string WrongAfter(const std::string& file, const Change& change) const {
    const std::string text = ReadWholeFile(run_ + "/" + file);
    Json json = Json::parse(text);
    change(&json);
    Write(file, json);
    const Outcome check = RunProgram(scratch_, "certificate check " + run_);
    EXPECT_EQ(check.code, 3) << check.out << check.err;
    std::ofstream(run_ + "/" + file) << text;
    return check.out;
  }

  const Scratch scratch_;
  const std::string run_ = scratch_ / "run";
};

TEST_F(ProofCommands, TheRunProvesAndVerifyDoesItAgain) {
  const Json report = Read("report.json");
  EXPECT_TRUE(report["proof"]["proved"]);
  EXPECT_EQ(report["proof"]["intervals"], 11);
  int bounds = 0;
  for (const Json& r : report["requirements"]) {
    if (!r["bound"].is_number()) continue;
    const double bound = r["bound"], value = r["value"], limit = r["limit"];
    const bool tangle = r["kind"] == "tangle";
    EXPECT_TRUE(tangle ? bound <= value && bound > limit : bound >= value && bound <= limit) << r;
    ++bounds;
  }
  EXPECT_GE(bounds, 8);
  const Outcome verify = RunProgram(scratch_, "verify " + run_);
  EXPECT_EQ(verify.code, 0);
  EXPECT_TRUE(Has(verify.out, "proved for all t")) << verify.out;
  EXPECT_FALSE(Has(RunProgram(scratch_, "verify --samples " + run_).out, "proved"));
}

TEST_F(ProofCommands, WhatIsLostIsNamed) {
  fs::copy_file(run_ + "/source.glb", run_ + "/scene.glb", fs::copy_options::overwrite_existing);
  const Outcome verify = RunProgram(scratch_, "verify " + run_);
  EXPECT_EQ(verify.code, 3);
  EXPECT_TRUE(Has(verify.out, "not proved: ")) << verify.out;
  EXPECT_TRUE(Has(verify.out, " at 0.0")) << verify.out;
  const Json json = Json::parse(RunProgram(scratch_, "verify --json " + run_).out);
  ASSERT_FALSE(json["proof"]["findings"].empty());
  double before = 0;
  for (const Json& f : json["proof"]["findings"]) {
    EXPECT_GE(f["time_s"].get<double>(), before);
    before = f["time_s"];
    EXPECT_TRUE(f["lost"]);
  }
  EXPECT_TRUE(Has(RunProgram(scratch_, "certificate check " + run_).out, "its hash differs"));
}

TEST_F(ProofCommands, ACertificateHoldsUntilItIsTouched) {
  const Outcome check = RunProgram(scratch_, "certificate check " + run_);
  EXPECT_EQ(check.code, 0) << check.out << check.err;
  EXPECT_TRUE(Has(check.out, "the certificate holds"));
  EXPECT_EQ(RunProgram(scratch_, "certificate diff " + run_ + " " + run_).out,
            "both certify the same\n");

  const auto certificate = [&](auto change) { return WrongAfter("certificate.json", change); };
  EXPECT_TRUE(Has(certificate([](Json* j) { (*j)["intervals"]["rows"][3][2] = 0.999; }),
                  "interval 3 claims 0.999"));
  EXPECT_TRUE(Has(certificate([](Json* j) { (*j)["intervals"]["rows"].erase(4); }), "intervals"));
  EXPECT_TRUE(Has(certificate([](Json* j) { (*j)["statements"].erase(1); }), "no such statement"));
  EXPECT_TRUE(Has(certificate([](Json* j) { (*j)["statements"][0]["limit"] = 0.1; }),
                  "config.yaml requires"));
  EXPECT_TRUE(Has(certificate([](Json* j) { (*j)["scene"]["hash"] = "sha256:0"; }), "hash"));
  EXPECT_TRUE(Has(certificate([](Json* j) { (*j)["proved"] = false; }), "not proved"));
  // Less to keep: thinner limbs, no hold.
  EXPECT_TRUE(Has(WrongAfter("report.json",
                             [](Json* j) { (*j)["bodies"]["a"]["radius"]["left_hand"] = 0.001; }),
                  "not those that were certified"));
  EXPECT_TRUE(Has(WrongAfter("report.json", [](Json* j) { (*j)["holds"] = Json::array(); }),
                  "not those that were certified"));
  // Limits that nobody keeps: the second checker finds it by itself.
  const std::string config = run_ + "/config.yaml";
  std::string text = ReadWholeFile(config);
  const size_t at = text.find("gli: 0.5");
  ASSERT_NE(at, std::string::npos) << text;
  text.replace(at, 8, "gli: 1.5");
  std::ofstream(config) << text;
  EXPECT_TRUE(
      Has(RunProgram(scratch_, "certificate check " + run_).out, "tangle 1: not confirmed"));
}

TEST_F(ProofCommands, ScenesOfOtherProgramsAreProvedAgainstATemplate) {
  const std::string with = " --template " + kHold + "/template.yaml";
  for (const std::string& scene : {"--scene " + run_ + "/scene.glb",
                                   "--scene " + run_ + "/a.bvh --scene " + run_ + "/b.bvh"}) {
    const Outcome verify = RunProgram(scratch_, "verify " + scene + with);
    EXPECT_EQ(verify.code, 0) << verify.out << verify.err;
    EXPECT_TRUE(Has(verify.out, "proved for all t")) << verify.out;
    EXPECT_TRUE(Has(verify.err, "planted feet are not judged")) << verify.err;
  }
  // The clips as they were captured, each alone, are no hug.
  const Outcome apart =
      RunProgram(scratch_, "verify --scene " + kHold + "/a.bvh --scene " + kHold + "/b.bvh" + with);
  EXPECT_EQ(apart.code, 3) << apart.err;
  EXPECT_TRUE(Has(apart.out, "not proved: ")) << apart.out;

  EXPECT_EQ(RunProgram(scratch_, "verify --scene " + run_ + "/scene.glb").code, 2);
  const Outcome one = RunProgram(scratch_, "verify --scene " + run_ + "/a.bvh" + with);
  EXPECT_EQ(one.code, 2);
  EXPECT_TRUE(Has(one.err, "name both figures")) << one.err;
  EXPECT_EQ(RunProgram(scratch_, "verify").code, 2);
}

}  // namespace
}  // namespace retarget::cli
