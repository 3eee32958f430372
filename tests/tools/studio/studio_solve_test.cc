// "Try it": a solve in a child process, watched, stopped and cleaned up after.
#include <thread>

#include "tests/tools/studio/studio_program.h"
#include "tools/report/report.h"
#include "tools/studio/child_process.h"

namespace retarget::studio {
namespace {

struct SentEvent {
  std::string name;
  report::Json data;
};

// The events of a job, until it is over or `until` has seen enough.
std::vector<SentEvent> Events(Studio* studio, const std::string& job,
                              const std::function<bool(const SentEvent&)>& until = nullptr,
                              const std::string& last_id = "") {
  std::vector<SentEvent> events;
  std::string text;
  httplib::Client client("127.0.0.1", studio->port);
  client.set_read_timeout(60);
  httplib::Headers headers = studio->Token();
  if (!last_id.empty()) headers.emplace("Last-Event-ID", last_id);
  client.Get("/api/solve/events?job=" + job, headers, [&](const char* bytes, size_t count) {
    text.append(bytes, count);
    for (size_t end; (end = text.find("\n\n")) != std::string::npos; text.erase(0, end + 2)) {
      std::istringstream lines(text.substr(0, end));
      SentEvent event;
      for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("event: ")) event.name = line.substr(7);
        if (line.starts_with("data: ")) event.data = report::Json::parse(line.substr(6));
      }
      if (event.name.empty()) continue;
      events.push_back(event);
      if (until && until(event)) return false;
    }
    return true;
  });
  return events;
}

report::Json Request(const std::string& session) {
  return {{"session", session},
          {"clip_a", "bear_hug/a.bvh"},
          {"clip_b", "bear_hug/b.bvh"},
          {"frames", "0:30"},
          {"settings", {{"solve.start", "template"}}}};
}

std::string Start(Studio* studio, const report::Json& request) {
  const auto reply = studio->Post("/api/solve", request);
  EXPECT_EQ(reply.status, 200) << reply.body;
  return reply.json.value("job", "");
}

std::string OpenHug(Studio* studio) {
  const std::string session = studio->Open();
  studio->Post("/api/load", {{"session", session}, {"template", "bear_hug"}});
  return session;
}

TEST(StudioSolve, IsWatchedToItsReport) {
  Studio studio;
  const std::string session = OpenHug(&studio);
  const std::string job = Start(&studio, Request(session));
  const auto busy = studio.Post("/api/solve", Request(session));
  ExpectRefusal(busy, 409, "running");
  const std::vector<SentEvent> events = Events(&studio, job);
  ASSERT_GT(events.size(), 5u);
  int iterations = 0;
  for (const SentEvent& event : events) {
    if (event.name != "progress") continue;
    ++iterations;
    EXPECT_GT(event.data["cost"].get<double>(), 0);
    EXPECT_GE(event.data["seconds"].get<double>(), 0);
  }
  EXPECT_GT(iterations, 3);
  const SentEvent& done = events.back();
  ASSERT_EQ(done.name, "done");
  EXPECT_TRUE(done.data["exit_code"] == 0 || done.data["exit_code"] == 3) << done.data.dump();
  EXPECT_FALSE(done.data["verdict"].get<std::string>().empty());
  EXPECT_FALSE(done.data["requirements"].empty());
  EXPECT_NE(studio.Get("/api/solve/report?job=" + job).body.find("<html"), std::string::npos);
  EXPECT_EQ(studio.Get("/api/solve/file?job=" + job + "&name=scene.glb").body.substr(0, 4), "glTF");
  const report::Json report =
      report::Json::parse(studio.Get("/api/solve/file?job=" + job + "&name=report.json").body);
  EXPECT_EQ(report["frames"], 30);
  EXPECT_EQ(report["requirements"], done.data["requirements"]);
  for (const char* name : {"../bear_hug_from_behind.yaml", "..", ".", "/etc/passwd", "", "no"}) {
    EXPECT_EQ(studio.Get("/api/solve/file?job=" + job + "&name=" + name).status, 404) << name;
  }
  // A page that lost the connection goes on where it was.
  const auto rest = Events(&studio, job, nullptr, std::to_string(events.size() - 2));
  ASSERT_EQ(rest.size(), 2u);
  EXPECT_EQ(rest.back().data, done.data);
  ExpectRefusal(studio.Get("/api/solve/report?job=000001-x"), 404);
}

TEST(StudioSolve, CanBeStoppedAtAnyTime) {
  Studio studio;
  const std::string session = OpenHug(&studio);
  report::Json request = Request(session);
  request["settings"] = {{"solve.polish_decrease", 1e-12}};
  // Before anything: at once, without a result.
  std::string job = Start(&studio, request);
  EXPECT_EQ(studio.Post("/api/solve/stop", {{"job", job}}).status, 200);
  std::vector<SentEvent> events = Events(&studio, job);
  EXPECT_EQ(events.back().name, "failed");
  EXPECT_EQ(events.back().data["stopped"], true);
  // While it iterates: the best so far, with a report.
  request["settings"] = {{"solve.start", "template"}, {"solve.polish_decrease", 1e-12}};
  job = Start(&studio, request);
  Events(&studio, job, [](const SentEvent& e) { return e.name == "progress"; });
  EXPECT_EQ(studio.Post("/api/solve/stop", {{"job", job}}).status, 200);
  events = Events(&studio, job);
  ASSERT_EQ(events.back().name, "done") << events.back().data.dump();
  EXPECT_EQ(events.back().data["exit_code"], 130);
  EXPECT_EQ(studio.Post("/api/solve/stop", {{"job", job}}).status, 200);  // is over: nothing to do
}

TEST(StudioSolve, BadInputIsOneSentence) {
  Scratch folder;
  folder.Write("broken.bvh", "HIERARCHY\nROOT");
  Studio studio({"--library", folder / ""});
  const std::string session = studio.Open();
  report::Json request = Request(session);
  request["clip_a"] = "broken.bvh";
  const std::string job = Start(&studio, request);
  const SentEvent last = Events(&studio, job).back();
  EXPECT_EQ(last.name, "failed");
  EXPECT_NE(last.data["error"].get<std::string>().find("broken.bvh"), std::string::npos);
  request["clip_a"] = "../broken.bvh";
  ExpectRefusal(studio.Post("/api/solve", request), 404, "broken");
  request["clip_a"] = "bear_hug/a.bvh";
  request["settings"] = {{"solve.strat", "template"}};
  ExpectRefusal(studio.Post("/api/solve", request), 400, "solve.start");
}

bool AnyChildOf(pid_t pid) {
  for (const auto& task : fs::directory_iterator("/proc/" + std::to_string(pid) + "/task")) {
    if (!ReadWholeFile(task.path() / "children").empty()) return true;
  }
  return false;
}

TEST(StudioSolve, NothingIsLeftBehind) {
  Studio studio;
  const std::string job = Start(&studio, Request(OpenHug(&studio)));
  EXPECT_TRUE(AnyChildOf(studio.pid()));
  const std::string children = [&] {
    std::string all;
    for (const auto& task :
         fs::directory_iterator("/proc/" + std::to_string(studio.pid()) + "/task")) {
      all += ReadWholeFile(task.path() / "children");
    }
    return all;
  }();
  const pid_t child = std::stoi(children);
  EXPECT_FALSE(fs::is_empty(studio.scratch / "tmp"));
  EXPECT_EQ(studio.End(SIGTERM), 0);
  EXPECT_NE(kill(child, 0), 0);
  EXPECT_TRUE(fs::is_empty(studio.scratch / "tmp"));
}

}  // namespace
}  // namespace retarget::studio
