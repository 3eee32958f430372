#include "tools/studio/routes.h"

#include <fmt/format.h>

#include "io/template_file.h"
#include "io/text/base64.h"
#include "io/text/json.h"
#include "io/text/nearest_name.h"
#include "io/text/quoted.h"
#include "tools/api/clip_posture.h"
#include "tools/studio/answers.h"
#include "tools/studio/error.h"
#include "tools/studio/guard.h"
#include "tools/studio/image.h"

namespace retarget::studio {
namespace {

constexpr size_t kMostOps = 64, kMostParameters = 16;
constexpr int kMostFrames = 10'000'000;
constexpr size_t kLongestId = 200, kLongestYaml = 1 << 20;  // bytes
constexpr size_t kMostThumbnail = 700'000;                  // bytes of its base64

std::string TextOr(const io::Value& fields, const char* key, size_t most = kLongestId) {
  return fields.Has(key) ? fields.Require(key).Text(most) : std::string();
}

// A PNG of the page's canvas.
std::string ThumbnailOf(const io::Value& fields) {
  if (!fields.Has("thumbnail")) return "";
  std::string text = fields.Require("thumbnail").Text(kMostThumbnail);
  const std::string prefix = "data:image/png;base64,";
  if (text.starts_with(prefix)) text.erase(0, prefix.size());
  std::string bytes;
  try {
    bytes = io::DecodeBase64(text);
  } catch (const InputError&) {
  }
  const auto kind = ImageKindOf(bytes);
  if (!kind || kind->type != std::string("image/png"))
    fields.Require("thumbnail").RefuseExpecting("a PNG in base64");
  return bytes;
}

// The route that was meant, where none is called so.
[[noreturn]] void RefuseRoute(const StudioRequest& request, const std::vector<std::string>& names) {
  const std::string asked = request.method + " " + io::Printable(request.path);
  throw StudioError(
      404, fmt::format("the studio does not know {}{}", asked, io::Suggestion(asked, names)));
}

}  // namespace

StudioAnswer JsonAnswer(const report::Json& json) {
  StudioAnswer answer;
  answer.body = json.dump(-1, ' ', false, report::Json::error_handler_t::replace);
  return answer;
}

const std::string& Parameter(const StudioRequest& request, const std::string& name) {
  const auto at = request.parameters.find(name);
  if (at == request.parameters.end()) {
    throw InputError(fmt::format("expected ?{}=... in the address", name));
  }
  return at->second;
}

StudioAnswer ErrorAnswer(int status, const std::string& sentence, const std::string& reason) {
  report::Json json = {{"error", sentence}};
  if (!reason.empty()) json["reason"] = reason;
  StudioAnswer answer = JsonAnswer(json);
  answer.status = status;
  return answer;
}

StudioAnswer AnswerOf(const std::exception& error) {
  if (const auto* studio = dynamic_cast<const StudioError*>(&error)) {
    return ErrorAnswer(studio->status(), studio->what(), studio->reason());
  }
  if (dynamic_cast<const InputError*>(&error)) return ErrorAnswer(400, error.what());
  return ErrorAnswer(500, std::string("internal error: ") + error.what());
}

StudioRoutes::StudioRoutes(StudioStart start, StudioLibrary* library, StudioClips* clips,
                           StudioJobs* jobs)
    : start_(std::move(start)),
      library_(library),
      clips_(clips),
      jobs_(jobs),
      sessions_(start_.settings) {
  AddSessionRoutes();
  AddLibraryRoutes();
  AddPhotoRoutes();
  AddSolveRoutes();
}

StudioAnswer StudioRoutes::Answer(const StudioRequest& request) {
  try {
    return AnswerOrThrow(request);
  } catch (const std::exception& error) {
    return AnswerOf(error);
  }
}

StudioAnswer StudioRoutes::AnswerOrThrow(const StudioRequest& request) {
  if (request.parameters.size() > kMostParameters) throw InputError("too many parameters");
  const auto route = routes_.find(request.method + " " + request.path);
  if (route == routes_.end()) {
    std::vector<std::string> names;
    for (const auto& [name, other] : routes_) names.push_back(name);
    RefuseRoute(request, names);
  }
  return route->second(request);
}

StudioSessions::Locked StudioRoutes::SessionOf(const StudioRequest& request) {
  return sessions_.Find(Parameter(request, "session"));
}

// -- Sessions ------------------------------------------------------------------------------------

StudioPosture StudioRoutes::PostureToLoad(const io::Value& fields) const {
  const int given =
      fields.Has("yaml") + fields.Has("template") + fields.Has("rest") + fields.Has("clips");
  if (given != 1) throw InputError("expected one of yaml, template, rest, clips");
  if (fields.Has("yaml")) {
    StudioPosture out;
    out.posture = io::ParseTemplate(fields.Require("yaml").Text(kLongestYaml), "the text");
    return out;
  }
  if (fields.Has("template")) {
    return PostureOfLibrary(library_, fields.Require("template").Text(kLongestId));
  }
  if (fields.Has("clips")) {
    const io::Value clips = fields.Require("clips");
    clips.CheckKeys({"frame_a", "frame_b", "together"});
    const int frame_a = clips.Require("frame_a").Integer(0, kMostFrames);
    const auto own_b = clips.Find("frame_b");
    const int frame_b = own_b ? own_b->Integer(0, kMostFrames) : frame_a;
    return UnsavedPosture(
        api::PostureOfFrames(clips_->Both(), {frame_a, frame_b}, clips.Flag("together")));
  }
  const io::Value rest = fields.Require("rest");
  rest.CheckKeys({"stature", "distance"});
  double stature[2] = {1.75, 1.75};
  if (rest.Has("stature")) {
    const io::Value of = rest.Require("stature");
    of.CheckKeys({"a", "b"});
    if (const auto a = of.Find("a")) stature[0] = a->Number(0.5, 3);
    if (const auto b = of.Find("b")) stature[1] = b->Number(0.5, 3);
  }
  const auto distance = rest.Find("distance");
  return UnsavedPosture(
      posing::RestPosture(stature[0], stature[1], distance ? distance->Number(0, 100) : 1));
}

void StudioRoutes::AddSessionRoutes() {
  routes_["POST /api/session"] = [this](const StudioRequest& request) {
    const io::Document message = io::ParseJson(request.body);
    message.root().CheckKeys({});
    const std::string id = sessions_.Create(start_.posture);
    report::Json start = {{"library", library_->folder()}};
    if (start_.has_template) start["template"] = start_.posture.posture.name;
    if (!start_.posture.photo.empty()) start["photo"] = true;
    const report::Json clips = clips_->StartJson();
    if (!clips.empty()) start["clips"] = clips;
    report::Json reply = {{"session", id}, {"start", start}};
    reply.update(sessions_.Find(id)->WholeReply());
    return JsonAnswer(reply);
  };
  routes_["GET /api/state"] = [this](const StudioRequest& request) {
    return JsonAnswer(SessionOf(request)->WholeReply());
  };
  routes_["GET /api/yaml"] = [this](const StudioRequest& request) {
    return StudioAnswer{200, "text/yaml; charset=utf-8", SessionOf(request)->Text()};
  };
  routes_["POST /api/load"] = [this](const StudioRequest& request) {
    const io::Document message = io::ParseJson(request.body);
    const io::Value fields = message.root();
    fields.CheckKeys({"session", "yaml", "template", "rest", "clips"});
    const auto session = sessions_.Find(fields.Require("session").Text(kLongestId));
    session->Load(PostureToLoad(fields));
    return JsonAnswer(session->WholeReply());
  };
  routes_["POST /api/do"] = [this](const StudioRequest& request) {
    const io::Document message = io::ParseJson(request.body);
    const io::Value fields = message.root();
    fields.CheckKeys({"session", "ops", "live"});
    const bool live = fields.Flag("live");
    const std::vector<io::Value> ops = fields.Require("ops").List(kMostOps);
    const auto session = sessions_.Find(fields.Require("session").Text(kLongestId));
    const auto result = session->Do(ops, live);
    return JsonAnswer(session->Reply(live, result));
  };
}

// -- Library -------------------------------------------------------------------------------------

void StudioRoutes::AddLibraryRoutes() {
  routes_["GET /api/library"] = [this](const StudioRequest&) {
    return JsonAnswer({{"folder", library_->folder()}, {"templates", library_->List()}});
  };
  routes_["GET /api/library/thumbnail"] = [this](const StudioRequest& request) {
    return StudioAnswer{200, "image/png", library_->Thumbnail(Parameter(request, "id"))};
  };
  routes_["POST /api/save"] = [this](const StudioRequest& request) {
    const io::Document message = io::ParseJson(request.body);
    const io::Value fields = message.root();
    fields.CheckKeys({"session", "id", "as", "overwrite", "thumbnail"});
    const std::string thumbnail = ThumbnailOf(fields);
    const auto session = sessions_.Find(fields.Require("session").Text(kLongestId));
    return JsonAnswer(session->Save(library_, TextOr(fields, "id"), TextOr(fields, "as"),
                                    fields.Flag("overwrite"), thumbnail));
  };
  routes_["POST /api/duplicate"] = [this](const StudioRequest& request) {
    const io::Document message = io::ParseJson(request.body);
    const io::Value fields = message.root();
    fields.CheckKeys({"id", "as"});
    return JsonAnswer({{"id", library_->Duplicate(fields.Require("id").Text(kLongestId),
                                                  fields.Require("as").Text(kLongestId))}});
  };
  routes_["POST /api/delete"] = [this](const StudioRequest& request) {
    const io::Document message = io::ParseJson(request.body);
    const io::Value fields = message.root();
    fields.CheckKeys({"id"});
    library_->Delete(fields.Require("id").Text(kLongestId));
    return JsonAnswer(report::Json::object());
  };
}

void StudioRoutes::AddPhotoRoutes() {
  routes_["GET /api/photo"] = [this](const StudioRequest& request) {
    const auto session = SessionOf(request);
    const std::string* photo = session->photo();
    if (!photo) throw StudioError(404, "this posture has no photo");
    return StudioAnswer{200, ImageKindOf(*photo)->type, *photo};
  };
  routes_["POST /api/photo"] = [this](const StudioRequest& request) {
    const auto session = SessionOf(request);
    session->SetPhotoBytes(request.body);
    return JsonAnswer(session->Reply(false));
  };
  routes_["DELETE /api/photo"] = [this](const StudioRequest& request) {
    const auto session = SessionOf(request);
    session->RemovePhoto();
    return JsonAnswer(session->Reply(false));
  };
}

}  // namespace retarget::studio
