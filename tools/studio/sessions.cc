#include "tools/studio/sessions.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/files.h"
#include "io/template_file.h"
#include "tools/posing/json.h"
#include "tools/posing/queries.h"
#include "tools/studio/error.h"
#include "tools/studio/guard.h"
#include "tools/studio/image.h"
#include "tools/studio/paths.h"
#include "tools/studio/state.h"

namespace retarget::studio {
namespace {

constexpr int kLiveIterations = 12, kAllIterations = 200;
constexpr double kLiveSeconds = 0.02;         // 30 Hz on a busy machine too; the next step goes on
constexpr size_t kMostPhotoBytes = 32 << 20;  // of a session
constexpr size_t kMostDocuments = 1000;

bool SameBodies(const std::array<Body, 2>& x, const std::array<Body, 2>& y) {
  const auto same_link = [](const Link& u, const Link& v) { return u.centre == v.centre; };
  const auto same_node = [](const Node& u, const Node& v) {
    return u.offset == v.offset && u.radius == v.radius;
  };
  const auto same = [&](const Body& u, const Body& v) {
    return u.stature == v.stature && u.num_links() == v.num_links() &&
           u.num_nodes() == v.num_nodes() &&
           std::equal(u.links.begin(), u.links.end(), v.links.begin(), same_link) &&
           std::equal(u.nodes.begin(), u.nodes.end(), v.nodes.begin(), same_node);
  };
  return same(x[0], y[0]) && same(x[1], y[1]);
}

}  // namespace

StudioPosture UnsavedPosture(TemplatePosture posture) {
  StudioPosture out;
  out.document.text = io::FormatTemplate(posture);
  out.posture = std::move(posture);
  return out;
}

StudioPosture PostureOfLibrary(StudioLibrary* library, const std::string& id) {
  const LibraryFile file = library->Read(id);
  StudioPosture out = UnsavedPosture(io::ParseTemplate(file.text, id + ".yaml"));
  out.document.id = id;
  out.document.hash = file.hash;
  out.photo = file.photo;
  return out;
}

StudioSession::StudioSession(const StudioPosture& start, const Settings& settings)
    : pose_(start.posture, settings), documents_{start.document} {
  if (start.posture.photo && !start.photo.empty()) {
    KeepPhoto(start.posture.photo->file, start.photo);
  }
}

std::optional<solver::PoseResult> StudioSession::Do(const std::vector<io::Value>& ops, bool live) {
  std::vector<posing::PoseStep> steps;
  for (const io::Value& op : ops) steps.push_back(posing::ParsePoseJson(op, pose_.posture()));
  if (steps.size() == 1) return DoSteps(steps, live);
  for (const posing::PoseStep& step : steps) {
    if (std::holds_alternative<posing::HistoryStep>(step)) {
      throw InputError("undo and redo: expected to be the only operation of a message");
    }
  }
  const posing::PoseSession before = pose_;
  try {
    return DoSteps(steps, live);
  } catch (const InputError& error) {
    pose_ = before;
    throw InputError(std::string("nothing was done: ") + error.what());
  } catch (...) {
    pose_ = before;
    throw;
  }
}

std::optional<solver::PoseResult> StudioSession::DoSteps(const std::vector<posing::PoseStep>& steps,
                                                         bool live) {
  std::optional<solver::PoseResult> result;
  for (size_t k = 0; k < steps.size(); ++k) {
    if (const auto* history = std::get_if<posing::HistoryStep>(&steps[k])) {
      const bool undo = *history == posing::HistoryStep::kUndo;
      if (!(undo ? pose_.Undo() : pose_.Redo())) {
        throw InputError(undo ? "there is nothing to undo" : "there is nothing to redo");
      }
      continue;
    }
    const auto solved =
        pose_.Apply(std::get<posing::Operation>(steps[k]), live ? kLiveIterations : kAllIterations,
                    live ? kLiveSeconds : 0);
    if (solved) result = solved;
    pose_.Join(true);
  }
  pose_.Join(false);
  ++revision_;
  return result;
}

void StudioSession::Load(const StudioPosture& posture) {
  if (documents_.size() >= kMostDocuments) {
    throw InputError("too many templates were opened here; reload the page");
  }
  documents_.push_back(posture.document);
  if (posture.posture.photo && !posture.photo.empty()) {
    KeepPhoto(posture.posture.photo->file, posture.photo);
  }
  pose_.Apply(posing::SetPosture{posture.posture, static_cast<int>(documents_.size()) - 1});
  ++revision_;
}

report::Json StudioSession::State(bool live) {
  const bool dirty = live || io::FormatTemplate(pose_.posture()) != document().text;
  report::Json state = {{"revision", revision_}, {"dirty", dirty}};
  state["saved_as"] = document().id.empty() ? report::Json(nullptr) : report::Json(document().id);
  state.update(PostureStateJson(pose_));
  state["queries"] = live ? posing::LiveQueriesJson(pose_.posture(), tags_)
                          : posing::QueriesJson(pose_.posture(), &tags_, pose_.settings());
  return state;
}

report::Json StudioSession::Reply(bool live, const std::optional<solver::PoseResult>& result) {
  report::Json reply = {{"state", State(live)}};
  if (!SameBodies(sent_body_, pose_.posture().body)) {
    sent_body_ = pose_.posture().body;
    reply["body"] = BodiesJson(sent_body_);
  }
  if (result) reply["result"] = PoseResultJson(*result, pose_.posture());
  return reply;
}

report::Json StudioSession::WholeReply() {
  sent_body_ = {};
  return Reply(false);
}

report::Json StudioSession::Save(StudioLibrary* library, const std::string& id,
                                 const std::string& as, bool overwrite,
                                 const std::string& thumbnail) {
  LibrarySave save;
  save.id = CheckedId(!as.empty() ? as : !id.empty() ? id : document().id);
  save.overwrite = overwrite;
  save.thumbnail = thumbnail;
  if (save.id == document().id) save.expected_hash = document().hash;
  TemplatePosture posture = pose_.posture();
  std::string warning;
  const std::string* bytes = photo();
  const std::string photo_was = posture.photo ? posture.photo->file : "";
  if (bytes) {
    save.photo = *bytes;
    save.photo_extension = ImageKindOf(save.photo)->extension;
    posture.photo->file = library->PhotoFile(save.id, save.photo_extension);
  } else if (posture.photo) {
    warning = fmt::format("the photo {} is not there; the template names it still", photo_was);
  }
  save.text = io::FormatTemplate(posture);
  io::ParseTemplate(save.text, save.id + ".yaml");  // what is written can be read
  const std::string hash = library->Save(save);
  if (bytes) {
    KeepPhoto(posture.photo->file, save.photo);
    pose_.RenamePhoto(photo_was, posture.photo->file);
  }
  document() = {save.id, hash, save.text};
  ++revision_;
  report::Json reply = Reply(false);
  reply["id"] = save.id;
  if (!warning.empty()) reply["warning"] = warning;
  return reply;
}

const std::string* StudioSession::photo() const {
  const auto& photo = pose_.posture().photo;
  if (!photo) return nullptr;
  const auto at = photos_.find(photo->file);
  return at == photos_.end() ? nullptr : &at->second;
}

void StudioSession::KeepPhoto(const std::string& file, const std::string& bytes) {
  size_t kept = bytes.size();
  for (const auto& [name, other] : photos_) kept += other.size();
  if (kept > kMostPhotoBytes) photos_.clear();  // undone photos are lost, the latest is not
  photos_[file] = bytes;
}

void StudioSession::SetPhotoBytes(const std::string& bytes) {
  const std::optional<ImageKind> kind = ImageKindOf(bytes);
  if (!kind) throw InputError("photo: expected a PNG, JPEG or WebP picture");
  TemplatePhoto photo;
  photo.file = fmt::format("photo-{}.{}", io::HashOf(bytes).substr(8), kind->extension);
  KeepPhoto(photo.file, bytes);
  pose_.Apply(posing::SetPhoto{photo});
  ++revision_;
}

void StudioSession::RemovePhoto() {
  pose_.Apply(posing::SetPhoto{});
  ++revision_;
}

std::string StudioSessions::Create(const StudioPosture& start) {
  const std::string id = RandomToken();
  int taken = 0;
  {
    const std::lock_guard lock(table_mutex_);
    for (int k = 1; k < kMost; ++k) {
      if (table_[k].used < table_[taken].used) taken = k;
    }
    table_[taken] = {id, ++clock_};
  }
  Slot& slot = slots_[taken];
  const std::lock_guard lock(slot.mutex);
  slot.owner = id;
  slot.session.emplace(start, settings_);
  return id;
}

StudioSessions::Locked StudioSessions::Find(const std::string& id) {
  int at = -1;
  {
    const std::lock_guard lock(table_mutex_);
    for (int k = 0; k < kMost; ++k) {
      if (!id.empty() && table_[k].id == id) at = k;
    }
    if (at >= 0) table_[at].used = ++clock_;
  }
  if (at >= 0) {
    std::unique_lock lock(slots_[at].mutex);
    // Another page may have taken the place meanwhile.
    if (slots_[at].owner == id) return {std::move(lock), &*slots_[at].session};
  }
  throw StudioError(404, "this editing session is over; load the page again");
}

}  // namespace retarget::studio
