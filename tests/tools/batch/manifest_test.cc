// Manifests of batches: formats, sweeps, names, paths, messages.
#include "tools/batch/manifest.h"

#include <map>

#include "tests/tools/run_program.h"
#include "tools/batch/batch.h"

namespace retarget::batch {
namespace {

const std::vector<Option> kOptions = {{"clip-a", false}, {"clip-b", false}, {"template", false},
                                      {"fps", false},    {"frames", false}, {"repair-a", true},
                                      {"also", false}};

std::vector<Pair> Parse(const std::string& text, const Common& common = {}) {
  return ParseManifest(text, "m", "", kOptions, common);
}

std::string MessageOf(const std::string& text, const Common& common = {}) {
  try {
    Parse(text, common);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::vector<std::string> IdsOf(const std::vector<Pair>& pairs) {
  std::vector<std::string> ids;
  for (const Pair& pair : pairs) ids.push_back(pair.id);
  return ids;
}

// The same two pairs in each notation.
TEST(BatchManifest, CsvJsonLinesAndYamlSayTheSame) {
  const std::string csv =
      "\xEF\xBB\xBFid, clip_a, --clip-b, template, weights.tangle, repair-a, also\r\n"
      "one,a.bvh,\"b, the second.bvh\",t.yaml,\"5, 20\",true,\"npz,csv\"\r\n"
      "\r\n"
      "two,a.bvh,b.bvh,t.yaml,,,\r\n";
  const std::string lines =
      "{\"id\": \"one\", \"clip_a\": \"a.bvh\", \"clip-b\": \"b, the second.bvh\", "
      "\"template\": \"t.yaml\", \"weights.tangle\": [5, 20], \"repair_a\": true, "
      "\"also\": \"npz,csv\"}\n\n"
      "{\"id\": \"two\", \"clip_a\": \"a.bvh\", \"clip_b\": \"b.bvh\", \"template\": \"t.yaml\"}";
  const std::string yaml =
      "# two pairs\n"
      "- {id: one, clip_a: a.bvh, clip_b: 'b, the second.bvh', template: t.yaml, "
      "weights.tangle: '5,20', repair_a: true, also: 'npz,csv'}\n"
      "- id: two\n  clip_a: a.bvh\n  clip_b: b.bvh\n  template: t.yaml\n  fps:\n";
  for (const std::string& text : {csv, lines, yaml}) {
    const std::vector<Pair> pairs = Parse(text);
    ASSERT_EQ(IdsOf(pairs),
              (std::vector<std::string>{"one@weights.tangle=5", "one@weights.tangle=20", "two"}));
    EXPECT_EQ(pairs[0].row_id, "one");
    EXPECT_EQ(pairs[1].swept, (std::vector<std::string>{"weights.tangle"}));
    EXPECT_EQ(pairs[1].Column("weights.tangle"), "20");
    EXPECT_EQ(pairs[1].Column("clip-b"), "b, the second.bvh");
    EXPECT_EQ(pairs[1].Column("repair-a"), "true");
    EXPECT_EQ(pairs[1].Column("also"), "npz,csv");
    EXPECT_EQ(pairs[2].columns.size(), 3u);
  }
}

TEST(BatchManifest, SweepsMultiplyAndCommonColumnsFillIn) {
  const std::string text =
      "id,clip_a,clip_b,template,weights.tangle,fps\np,a,b,t,\"1,2,3\",\"30,60\"\nq,a,b,t,7,\n";
  const std::vector<Pair> pairs = Parse(text, {"weights.hold=4,5", "fps=24"});
  ASSERT_EQ(pairs.size(), 14u);
  EXPECT_EQ(pairs[0].id, "p@weights.tangle=1@fps=30@weights.hold=4");
  EXPECT_EQ(pairs[13].id, "q@weights.hold=5");
  EXPECT_EQ(pairs[13].Column("fps"), "24");
  std::map<std::string, int> seen;
  for (const Pair& pair : pairs) ++seen[pair.id];
  EXPECT_EQ(seen.size(), pairs.size());
}

TEST(BatchManifest, RefusalsNameThePlaceAndTheNearestName) {
  const std::string head = "id,clip_a,clip_b,template";
  const struct {
    std::string text, expected;
  } cases[] = {
      {head + ",weights.tangel\nx,a,b,t,1\n",
       "m:2: unknown column \"weights.tangel\", did you "
       "mean \"weights.tangle\"?"},
      {head + ",frame\nx,a,b,t,1\n", "did you mean \"frames\"?"},
      {"id,clip_a,template\nx,a,t\n", "m:2: column \"clip-b\" is missing"},
      {head + "\nx,a,b,t\nx,a,b,t\n", "m:3: id: \"x\" is there twice"},
      {head + "\n,a,b,t\n", "m:2: id: found nothing"},
      {head + "\n../x,a,b,t\n", "m:2: id: found \"../x\""},
      {head + "\nindex.html,a,b,t\n", "m:2: id: found \"index.html\""},
      {head + "\nx,a,b,t,extra\n", "m:2: found 5 cells, expected 4"},
      {head + "\nx,\"a,b,t\n", "m:2: a quote is not closed"},
      {head + "\nx,\"a\"a,b,t\n", "m:2: found text after a closing quote"},
      {head + ",fps\nx,a,b,t,\"30,,60\"\n", "m:2: fps: found \"30,,60\""},
      {head + ",repair_a\nx,a,b,t,yes\n", "m:2: repair-a: found \"yes\", expected true or false"},
      {head + ",clip-a\nx,a,b,t,a\n", "m:2: column \"clip-a\" is given twice"},
      {head + "\n", "m: found no pairs"},
      {"", "m: found no pairs"},
      {"{\"id\": \"x\"\n", "m:1: the message is not JSON"},
      {"{\"id\": {}}\n", "m:1: id: expected a number, a text or a list"},
      {"- id: [x]\n", "found a list"},
      {"- 5\n", "expected"},
  };
  for (const auto& c : cases) {
    EXPECT_NE(MessageOf(c.text).find(c.expected), std::string::npos) << c.text << "\n"
                                                                     << MessageOf(c.text);
  }
  EXPECT_NE(MessageOf(head + "\nx,a,b,t\n", {"fsp=3"}).find("fsp=3: unknown column"),
            std::string::npos);
}

TEST(BatchManifest, FilesAreLookedForBesideTheManifest) {
  const Scratch scratch;
  fs::create_directories(scratch / "clips");
  for (const char* name : {"clips/a.bvh", "clips/s.asf", "clips/m.amc", "t.yaml"}) {
    scratch.Write(name, "x");
  }
  const std::string manifest = scratch.Write(
      "m.csv",
      "id,clip_a,clip_b,template\nx,clips/a.bvh#figure=1,clips/s.asf:clips/m.amc,t.yaml\n");
  const std::vector<Pair> pairs = ReadManifest(manifest, kOptions, {});
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].Column("clip-a"), scratch / "clips/a.bvh#figure=1");
  EXPECT_EQ(pairs[0].Column("clip-b"), (scratch / "clips/s.asf") + ":" + (scratch / "clips/m.amc"));
  EXPECT_EQ(pairs[0].Column("template"), scratch / "t.yaml");
}

TEST(BatchManifest, PatternsPairEveryClipOrThoseOfOneName) {
  const Scratch scratch;
  fs::create_directories(scratch / "a");
  fs::create_directories(scratch / "b");
  for (const char* name : {"a/walk.bvh", "a/run.bvh", "b/walk.bvh", "b/run.bvh", "b/fall.bvh"}) {
    scratch.Write(name, "x");
  }
  const std::string a = scratch / "a/*.bvh", b = scratch / "b/*.bvh";
  const auto ids = [&](Pairing pairing) {
    return IdsOf(Parse(ManifestOfPatterns(a, b, {"t.yaml"}, pairing)));
  };
  EXPECT_EQ(ids(Pairing::kAll), (std::vector<std::string>{"run-fall", "run-run", "run-walk",
                                                          "walk-fall", "walk-run", "walk-walk"}));
  EXPECT_EQ(ids(Pairing::kName), (std::vector<std::string>{"run", "walk"}));
  EXPECT_EQ(Parse(ManifestOfPatterns(a, b, {"t.yaml", "u.yaml"}, Pairing::kAll)).size(), 12u);
  EXPECT_THROW(ManifestOfPatterns(scratch / "c/*", b, {"t.yaml"}, Pairing::kAll), InputError);
}

TEST(BatchShard, TasksOfAnArrayAndGivenOnesCoverEachPairOnce) {
  EXPECT_THROW(ParseShard("3"), InputError);
  EXPECT_THROW(ParseShard("3/3"), InputError);
  EXPECT_THROW(ParseShard("0/3x"), InputError);
  std::string csv = "id,clip_a,clip_b,template\n";
  for (int k = 0; k < 10; ++k) csv += std::to_string(k) + "p,a,b,t\n";
  const std::vector<Pair> pairs = Parse(csv);
  std::map<std::string, int> seen;
  for (int task = 0; task < 3; ++task) {
    setenv("SLURM_ARRAY_TASK_COUNT", "3", 1);
    setenv("SLURM_ARRAY_TASK_MIN", "4", 1);
    setenv("SLURM_ARRAY_TASK_STEP", "2", 1);
    setenv("SLURM_ARRAY_TASK_ID", std::to_string(4 + 2 * task).c_str(), 1);
    const Shard shard = ShardOfSlurm();
    EXPECT_EQ(shard.index, task);
    for (const Job& job : PlanJobs(pairs, shard)) ++seen[job.pair.id];
  }
  for (const char* name : {"COUNT", "MIN", "STEP", "ID"}) {
    unsetenv((std::string("SLURM_ARRAY_TASK_") + name).c_str());
  }
  EXPECT_TRUE(ShardOfSlurm().whole());
  EXPECT_EQ(seen.size(), 10u);
  for (const auto& [id, count] : seen) EXPECT_EQ(count, 1) << id;
}

// What a pair's result depends on is in its hash, and what it does not depend on is not.
TEST(BatchPlan, TheHashFollowsContentsSettingsAndOptions) {
  const Scratch scratch;
  const auto clip = [&](const char* name) {
    return scratch.Write(name, ReadWholeFile(kHold + "/a.bvh"));
  };
  const std::string a = clip("a.bvh"), copy = clip("copy.bvh");
  const std::string config = scratch.Write("c.yaml", "weights: {tangle: 7}\n");
  const auto job = [&](const std::string& more, const std::string& path) {
    return PlanJobs(Parse("- {id: x, clip_a: " + path + ", clip_b: " + kHold +
                          "/b.bvh, template: " + kHold + "/template.yaml" + more + "}\n"),
                    {})[0];
  };
  const Job plain = job("", a);
  EXPECT_GT(plain.frames, 200);
  EXPECT_EQ(job("", copy).hash, plain.hash);
  EXPECT_EQ(job(", weights.tangle: 20", a).hash, plain.hash);  // the default
  EXPECT_EQ(job(", weights.tangle: 7", a).hash,
            PlanJobs(Parse("- {id: x, clip_a: " + a + ", clip_b: " + kHold +
                           "/b.bvh, template: " + kHold + "/template.yaml, weights.tangle: 7}\n"),
                     {})[0]
                .hash);
  std::map<std::string, std::string> hashes = {{"plain", plain.hash}};
  hashes["setting"] = job(", weights.tangle: 7", a).hash;
  hashes["option"] = job(", fps: 60", a).hash;
  hashes["frames"] = job(", frames: '0:9'", a).hash;
  hashes["select"] = job("", a + "#figure=0").hash;
  hashes["missing"] = job("", "/nowhere.bvh").hash;
  std::ofstream(a, std::ios::app) << "\n";
  hashes["content"] = job("", a).hash;
  std::map<std::string, int> different;
  for (const auto& [what, hash] : hashes) ++different[hash];
  EXPECT_EQ(different.size(), hashes.size());
  EXPECT_EQ(job(", frames: '0:9'", a).frames, 9);
}

}  // namespace
}  // namespace retarget::batch
