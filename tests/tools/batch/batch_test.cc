// `retarget batch` as a user meets it: killed, resumed, sharded, merged, with bad pairs among good.
#include <signal.h>

#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <thread>

#include "tests/tools/run_program.h"

namespace retarget::batch {
namespace {

using Json = nlohmann::json;

// `count` pairs of the shipped holds, of `frames` frames each that begin at different frames.
std::string ShippedPairs(int count, int frames) {
  std::vector<fs::path> holds;
  for (const auto& entry : fs::directory_iterator(ProjectPath("data/holds"))) {
    holds.push_back(entry.path());
  }
  std::sort(holds.begin(), holds.end());
  std::string csv = "id,clip_a,clip_b,template,frames,template_at\n";
  for (int k = 0; k < count; ++k) {
    const fs::path& hold = holds[static_cast<size_t>(k) % holds.size()];
    const int first = 3 * (k / static_cast<int>(holds.size()));
    csv += hold.filename().string() + "-" + std::to_string(first) + "," +
           (hold / "a.bvh").string() + "," + (hold / "b.bvh").string() + "," +
           (hold / "template.yaml").string() + "," + std::to_string(first) + ":" +
           std::to_string(first + frames) + "," + std::to_string(first / 30.0) + "\n";
  }
  return csv;
}

std::map<std::string, Json> Records(const std::string& folder, int* lines = nullptr) {
  std::map<std::string, Json> records;
  std::istringstream text(ReadWholeFile(folder + "/status.jsonl"));
  for (std::string line; std::getline(text, line);) {
    const Json json = Json::parse(line, nullptr, false);
    if (!json.is_object()) continue;  // cut short by a kill
    records[json["id"]] = json;
    if (lines) ++*lines;
  }
  return records;
}

std::set<std::string> FoldersIn(const std::string& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory()) names.insert(entry.path().filename());
  }
  return names;
}

pid_t Start(const std::vector<std::string>& words) {
  const pid_t pid = fork();
  if (pid != 0) return pid;
  std::freopen("/dev/null", "w", stdout);
  std::freopen("/dev/null", "w", stderr);
  std::vector<char*> argv = {const_cast<char*>(RETARGET_BINARY)};
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  execv(RETARGET_BINARY, argv.data());
  _exit(127);
}

int WaitFor(pid_t pid) {
  int status = 0;
  waitpid(pid, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// What a whole batch left.
void ExpectEqualBatches(const std::string& one, const std::string& other, int pairs) {
  EXPECT_EQ(ReadWholeFile(one + "/index.csv"), ReadWholeFile(other + "/index.csv"));
  EXPECT_EQ(ReadWholeFile(one + "/index.html"), ReadWholeFile(other + "/index.html"));
  int lines = 0;
  const std::map<std::string, Json> records = Records(other, &lines);
  EXPECT_EQ(lines, pairs);
  EXPECT_EQ(static_cast<int>(records.size()), pairs);
  EXPECT_EQ(FoldersIn(other), FoldersIn(one));  // nothing unfinished is left
  for (const auto& [id, record] : records) {
    if (record["exit_code"] == 2) continue;
    for (const char* file : {"scene.glb", "a.bvh", "b.bvh", "config.yaml"}) {
      EXPECT_EQ(ReadWholeFile(one + "/" + id + "/" + file),
                ReadWholeFile(other + "/" + id + "/" + file))
          << id << "/" << file;
    }
    EXPECT_TRUE(Json::accept(ReadWholeFile(other + "/" + id + "/report.json"))) << id;
  }
}

// Kills a batch `kills` times, anywhere, and resumes it each time.
void KillAndResume(int pairs, int frames, int kills) {
  const Scratch scratch;
  const std::string manifest = scratch.Write("m.csv", ShippedPairs(pairs, frames));
  const std::string undisturbed = scratch / "undisturbed", killed = scratch / "killed";
  const std::vector<std::string> words = {"batch", manifest, "--jobs=2", "--no-pictures"};
  auto whole = words;
  whole.push_back("--out=" + undisturbed);
  const auto begin = std::chrono::steady_clock::now();
  const int code = WaitFor(Start(whole));
  ASSERT_TRUE(code == 0 || code == 3) << code;
  // Of one pair, two being solved at once: kills come within, however fast the machine is.
  const std::chrono::duration<double> pair = (std::chrono::steady_clock::now() - begin) * 2 / pairs;

  auto again = words;
  again.push_back("--out=" + killed);
  again.push_back("--resume");
  std::mt19937 random(5);
  std::map<std::string, Json> finished;  // by any of the runs before
  int were_running = 0, grew = 0;
  for (int k = 0; k < kills; ++k) {
    const pid_t pid = Start(again);
    // After so many more pairs, anywhere in the next.
    const size_t enough = std::min(
        finished.size() + std::uniform_int_distribution<size_t>(0, 3 * pairs / kills / 2)(random),
        static_cast<size_t>(pairs) - 2);
    for (int wait = 0; wait < 2000 && Records(killed).size() < enough; ++wait) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    std::this_thread::sleep_for(std::uniform_real_distribution<>(0, 0.5)(random) * pair);
    were_running += kill(pid, 0) == 0;
    kill(pid, SIGKILL);
    const int ended = WaitFor(pid);
    were_running -= ended != 128 + SIGKILL;
    for (const auto& [id, record] : Records(killed)) {
      const bool whole_folder = fs::exists(killed + "/" + id + "/report.json");
      if (finished.count(id)) {
        EXPECT_EQ(finished[id]["ended"], record["ended"]) << id << " was run again";
      } else if (whole_folder) {
        finished[id] = record;
        ++grew;
      }
    }
    for (const std::string& id : FoldersIn(killed)) {
      if (id == ".unfinished") continue;
      for (const char* file : {"report.json", "scene.glb", "a.bvh", "b.bvh", "config.yaml"}) {
        EXPECT_TRUE(fs::exists(killed + "/" + id + "/" + file)) << id << " is half written";
      }
    }
  }
  EXPECT_GT(were_running, kills / 2) << "the test must kill something";
  EXPECT_GT(grew, 0);
  EXPECT_EQ(WaitFor(Start(again)), code);
  for (const auto& [id, record] : Records(killed)) {
    if (finished.count(id)) {
      EXPECT_EQ(finished[id]["ended"], record["ended"]) << id;
    }
  }
  ExpectEqualBatches(undisturbed, killed, pairs);
}

TEST(Batch, KilledAnywhereAndResumedItIsTheSame) { KillAndResume(9, 6, 4); }

TEST(NightlyBatch, TwoHundredPairsKilledTwentyTimes) { KillAndResume(200, 12, 20); }

TEST(Batch, OneBadPairNeverStopsTheRest) {
  const Scratch scratch;
  const std::string good = ",clip_a: " + kHold + "/a.bvh, clip_b: " + kHold +
                           "/b.bvh, template: " + kHold + "/template.yaml, frames: '0:6'";
  const std::string manifest = scratch.Write(
      "m.yaml", "- {id: good" + good + "}\n- {id: no-file" + good.substr(0, 9) +
                    "nowhere.bvh, clip_b: " + kHold + "/b.bvh, template: " + kHold +
                    "/template.yaml}\n- {id: no-setting" + good + ", weights.tangle: much}\n" +
                    "- {id: misses" + good + ", requirements.hold_m: 0, weights.hold: 0.01}\n");
  const std::string out = scratch / "out";
  const Outcome run = RunProgram(scratch, "batch " + manifest + " --jobs 2 --out " + out);
  EXPECT_EQ(run.code, 3) << run.err;
  const std::map<std::string, Json> records = Records(out);
  ASSERT_EQ(records.size(), 4u);
  EXPECT_EQ(records.at("good")["exit_code"], 0);
  EXPECT_EQ(records.at("no-file")["exit_code"], 2);
  EXPECT_NE(records.at("no-file")["error"].get<std::string>().find("nowhere.bvh"),
            std::string::npos);
  EXPECT_EQ(records.at("no-setting")["exit_code"], 2);
  EXPECT_NE(records.at("no-setting")["error"].get<std::string>().find("weights.tangle"),
            std::string::npos);
  EXPECT_EQ(records.at("misses")["exit_code"], 3);
  EXPECT_TRUE(records.at("misses")["missed"].get<std::string>().starts_with("hold"));
  EXPECT_EQ(FoldersIn(out), (std::set<std::string>{"good", "misses"}));
  EXPECT_TRUE(fs::exists(out + "/good/scene.png"));
  for (const char* word : {"no-file", "no-setting", "misses", "1 of 4 pairs"}) {
    EXPECT_NE(run.out.find(word), std::string::npos) << run.out;
  }

  // Without --resume nothing is touched; with it nothing is run again, but for what has changed.
  EXPECT_EQ(RunProgram(scratch, "batch " + manifest + " --out " + out).code, 2);
  const std::string resume = "batch " + manifest + " --resume --out " + out;
  EXPECT_EQ(RunProgram(scratch, resume).code, 3);
  for (const auto& [id, record] : Records(out)) EXPECT_EQ(record, records.at(id));
  scratch.Write("nowhere.bvh", ReadWholeFile(kHold + "/a.bvh"));
  fs::remove_all(out + "/misses");
  EXPECT_EQ(RunProgram(scratch, resume).code, 3);
  std::map<std::string, Json> after = Records(out);
  EXPECT_EQ(after.at("no-file")["exit_code"], 0);
  EXPECT_EQ(after.at("good"), records.at("good"));
  EXPECT_NE(after.at("misses")["ended"], "");
  EXPECT_TRUE(fs::exists(out + "/misses/report.json"));
}

TEST(Batch, AFolderOfTheUsersIsNotReplaced) {
  const Scratch scratch;
  const std::string manifest = scratch.Write("m.csv", ShippedPairs(1, 6));
  const std::string id = "argentine_backbreaker-0", out = scratch / "out";
  fs::create_directories(out + "/" + id);
  scratch.Write("out/" + id + "/mine.txt", "mine");
  EXPECT_EQ(RunProgram(scratch, "batch " + manifest + " --out " + out).code, 3);
  EXPECT_EQ(Records(out).at(id)["exit_code"], 2);
  EXPECT_EQ(ReadWholeFile(out + "/" + id + "/mine.txt"), "mine");
}

TEST(Batch, CtrlCLeavesAStateToResume) {
  const Scratch scratch;
  const std::string manifest = scratch.Write("m.csv", ShippedPairs(4, 150));
  const std::string out = scratch / "out";
  const auto begin = std::chrono::steady_clock::now();
  const pid_t pid = Start({"batch", manifest, "--jobs=1", "--no-pictures", "--out=" + out});
  while (Records(out).empty()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
    ASSERT_LT(waited.count(), 100);
  }
  // Meanwhile nobody else works there.
  const Outcome other = RunProgram(scratch, "batch " + manifest + " --resume --out " + out);
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("another process runs these pairs"), std::string::npos) << other.err;
  kill(pid, SIGINT);
  EXPECT_EQ(WaitFor(pid), 130);
  const std::map<std::string, Json> before = Records(out);
  EXPECT_LT(before.size(), 4u);
  EXPECT_FALSE(fs::exists(out + "/.unfinished"));
  EXPECT_EQ(FoldersIn(out).size(), before.size());
  EXPECT_NE(ReadWholeFile(out + "/index.html").find("not run yet"), std::string::npos);
}

TEST(Batch, ShardsBesideEachOtherMergeIntoTheIndexOfOne) {
  const Scratch scratch;
  const std::string manifest = scratch.Write("m.csv", ShippedPairs(5, 6));
  const std::string whole = scratch / "whole", parts = scratch / "parts";
  const std::string run = "batch " + manifest + " --no-pictures --out ";
  const int code = RunProgram(scratch, run + whole).code;
  const pid_t first = Start({"batch", manifest, "--no-pictures", "--shard=0/2", "--out=" + parts});
  const int second_code = RunProgram(scratch, run + parts + " --shard 1/2").code;
  EXPECT_EQ(std::max(WaitFor(first), second_code), code);
  EXPECT_FALSE(fs::exists(parts + "/index.csv"));
  EXPECT_EQ(RunProgram(scratch, "batch --merge --out " + parts).code, code);
  ExpectEqualBatches(whole, parts, 5);
  // One shard missing is said.
  fs::remove(parts + "/status.jsonl");
  fs::remove(parts + "/status.1-of-2.jsonl");
  EXPECT_EQ(RunProgram(scratch, "batch --merge --out " + parts).code, 3);
  EXPECT_NE(ReadWholeFile(parts + "/index.html").find("2 are not run yet"), std::string::npos);
}

TEST(Batch, ASweepHasItsCurvesAndPatternsTheirManifest) {
  const Scratch scratch;
  const std::string out = scratch / "out";
  const Outcome printed = RunProgram(scratch, "batch --pairs '" + kHold + "/a.bvh' '" + kHold +
                                                  "/b.bvh' --template " + kHold + "/template.yaml");
  EXPECT_EQ(printed.code, 0);
  EXPECT_TRUE(printed.out.starts_with("id,clip_a,clip_b,template\na-b,")) << printed.out;
  const std::string manifest = scratch.Write("m.csv", printed.out);
  const Outcome run = RunProgram(scratch, "batch " + manifest +
                                              " --with weights.pose_tracking=1,10 --with "
                                              "frames=0:8 --json --out " +
                                              out);
  EXPECT_TRUE(run.code == 0 || run.code == 3) << run.err;
  EXPECT_EQ(Json::parse(run.out)["pairs"].size(), 2u);
  EXPECT_EQ(FoldersIn(out),
            (std::set<std::string>{"a-b@weights.pose_tracking=1", "a-b@weights.pose_tracking=10"}));
  const std::string page = ReadWholeFile(out + "/index.html");
  EXPECT_NE(page.find("<h2>weights.pose_tracking</h2>"), std::string::npos);
  EXPECT_NE(page.find("<figcaption><small>pose error a, cm"), std::string::npos);
}

}  // namespace
}  // namespace retarget::batch
