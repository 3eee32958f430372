// Routes of "try it": clips, solves, their events and files.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "io/settings_file.h"
#include "io/text/json.h"
#include "tools/studio/answers.h"
#include "tools/studio/error.h"
#include "tools/studio/routes.h"

namespace retarget::studio {
namespace {

constexpr size_t kLongestId = 300, kMostSettings = 50, kLongestSetting = 100;

// "0:240", as --frames takes it.
std::string FramesOf(const io::Value& fields) {
  const std::string frames = fields.Require("frames").Text(40);
  const bool good =
      std::count(frames.begin(), frames.end(), ':') == 1 &&
      std::all_of(frames.begin(), frames.end(), [](char c) { return c == ':' || isdigit(c); });
  if (!good) fields.Require("frames").RefuseExpecting("a range such as \"0:240\"");
  return frames;
}

// "solve.start=template"; checked by the reader of settings itself.
void AddSettings(const io::Value& settings, std::vector<std::string>* arguments) {
  settings.CheckMap();
  if (settings.size() > kMostSettings) throw InputError("settings: too many");
  Settings scratch;
  for (const io::Value& value : settings.Items()) {
    if (value.kind() != io::Value::Kind::kScalar) {
      value.RefuseExpecting("a number, a text, true or false");
    }
    if (value.text().size() > kLongestSetting) value.Text(kLongestSetting);
    const std::string assignment = value.key() + "=" + value.text();
    io::SetByName(&scratch, assignment, "--set");
    arguments->push_back("--set");
    arguments->push_back(assignment);
  }
}

std::vector<std::string> ArgumentsOf(const io::Value& fields, const StudioClips& clips) {
  std::vector<std::string> arguments;
  for (int f = 0; f < 2; ++f) {
    const std::string id = fields.Require(f == 0 ? "clip_a" : "clip_b").Text(kLongestId);
    for (const std::string& argument : clips.Arguments(id, f)) arguments.push_back(argument);
  }
  if (fields.Has("frames")) {
    arguments.push_back("--frames");
    arguments.push_back(FramesOf(fields));
  }
  if (fields.Has("statures")) {
    const io::Value statures = fields.Require("statures");
    statures.CheckKeys({"a", "b"});
    for (const char* figure : report::kFigure) {
      if (!statures.Has(figure)) continue;
      arguments.push_back(std::string("--stature-") + figure);
      arguments.push_back(fmt::format("{}", statures.Require(figure).Number(0.5, 3)));
    }
  }
  if (fields.Has("settings")) {
    AddSettings(fields.Require("settings"), &arguments);
  }
  return arguments;
}

const char* TypeOf(const std::string& name) {
  const std::pair<const char*, const char*> types[] = {
      {".html", "text/html; charset=utf-8"}, {".json", "application/json; charset=utf-8"},
      {".glb", "model/gltf-binary"},         {".yaml", "text/yaml; charset=utf-8"},
      {".bvh", "text/plain; charset=utf-8"}, {".png", "image/png"}};
  const std::string extension = std::filesystem::path(name).extension().string();
  for (const auto& [own, type] : types) {
    if (extension == own) return type;
  }
  return "application/octet-stream";
}

}  // namespace

StudioAnswer StudioRoutes::StartSolve(const StudioRequest& request) {
  const io::Document message = io::ParseJson(request.body);
  const io::Value fields = message.root();
  fields.CheckKeys({"session", "clip_a", "clip_b", "frames", "statures", "settings"});
  SolveRequest solve;
  solve.arguments = ArgumentsOf(fields, *clips_);
  {
    const auto session = sessions_.Find(fields.Require("session").Text(kLongestId));
    solve.template_name = session->pose().posture().name;
    solve.template_text = session->Text();
  }
  return JsonAnswer({{"job", jobs_->Start(solve)}});
}

void StudioRoutes::AddSolveRoutes() {
  routes_["GET /api/clips"] = [this](const StudioRequest&) { return JsonAnswer(clips_->List()); };
  routes_["POST /api/solve"] = [this](const StudioRequest& request) { return StartSolve(request); };
  routes_["POST /api/solve/stop"] = [this](const StudioRequest& request) {
    const io::Document message = io::ParseJson(request.body);
    const io::Value fields = message.root();
    fields.CheckKeys({"job"});
    jobs_->Stop(fields.Require("job").Text(kLongestId));
    return JsonAnswer(report::Json::object());
  };
  routes_["GET /api/solve/events"] = [this](const StudioRequest& request) {
    const std::string job = Parameter(request, "job");
    if (!jobs_->Knows(job)) throw StudioError(404, "there is no such solve");
    size_t cursor = 0;  // a page that lost the connection goes on after what it has
    if (const auto after = request.parameters.find("after"); after != request.parameters.end()) {
      const std::string& text = after->second;
      std::from_chars(text.data(), text.data() + text.size(), cursor);
    }
    StudioAnswer answer;
    answer.type = "text/event-stream";
    answer.more = [this, job, cursor](std::string* text) mutable {
      return jobs_->NextEvents(job, &cursor, text);
    };
    return answer;
  };
  routes_["GET /api/solve/report"] = [this](const StudioRequest& request) {
    return StudioAnswer{200, "text/html; charset=utf-8",
                        jobs_->File(Parameter(request, "job"), "report.html")};
  };
  routes_["GET /api/solve/file"] = [this](const StudioRequest& request) {
    const std::string name = Parameter(request, "name");
    return StudioAnswer{200, TypeOf(name), jobs_->File(Parameter(request, "job"), name)};
  };
}

}  // namespace retarget::studio
