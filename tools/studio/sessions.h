// The studio's editing sessions: one per page, each with a lock of its own, so that a long solve in
// one page does not hold up another.
#pragma once

#include <array>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "io/text/document.h"
#include "model/body/tangle.h"
#include "tools/posing/session.h"
#include "tools/report/report.h"
#include "tools/studio/library.h"

namespace retarget::studio {

// A posture that was opened, and the file that it belongs to.
struct StudioDocument {
  std::string id;    // in the library; empty: none yet
  std::string hash;  // of the file as it was last seen
  std::string text;  // as saved; what differs from it is not saved
};

// What a session begins with, or goes on with.
struct StudioPosture {
  TemplatePosture posture;
  StudioDocument document;
  std::string photo;  // bytes; empty: none
};
StudioPosture UnsavedPosture(TemplatePosture posture);
StudioPosture PostureOfLibrary(StudioLibrary* library, const std::string& id);

class StudioSession {
 public:
  StudioSession(const StudioPosture& start, const Settings& settings);

  const posing::PoseSession& pose() const { return pose_; }

  // Does all operations, as one step of the history, or none. Throws InputError.
  std::optional<solver::PoseResult> Do(const std::vector<io::Value>& ops, bool live);
  // Another posture, as one step of the history.
  void Load(const StudioPosture& posture);
  // {state, body?: where it changed since it was last told, result?}.
  report::Json Reply(bool live, const std::optional<solver::PoseResult>& result = std::nullopt);
  report::Json WholeReply();  // with the body

  std::string Text() const { return pose_.Text(); }
  // {state, id, warning?}. `as` empty: to its own file, or to `id` where that is given.
  report::Json Save(StudioLibrary* library, const std::string& id, const std::string& as,
                    bool overwrite, const std::string& thumbnail);

  const std::string* photo() const;  // bytes; null: none
  void SetPhotoBytes(const std::string& bytes);
  void RemovePhoto();

 private:
  std::optional<solver::PoseResult> DoSteps(const std::vector<posing::PoseStep>& steps, bool live);
  StudioDocument& document() { return documents_[pose_.state().document]; }
  void KeepPhoto(const std::string& file, const std::string& bytes);
  report::Json State(bool live);

  posing::PoseSession pose_;
  std::vector<StudioDocument> documents_;  // by PoseState::document
  int64_t revision_ = 1;
  std::vector<Tag> tags_;  // as found last
  std::array<Body, 2> sent_body_;
  std::map<std::string, std::string> photos_;  // bytes by file name, for the whole history
};

class StudioSessions {
 public:
  // A session, locked while this lives.
  struct Locked {
    std::unique_lock<std::mutex> lock;
    StudioSession* session;
    StudioSession* operator->() const { return session; }
  };

  explicit StudioSessions(const Settings& settings) : settings_(settings) {}

  // Takes the place of the one unused longest where all are taken.
  std::string Create(const StudioPosture& start);
  Locked Find(const std::string& id);  // throws StudioError 404

 private:
  static constexpr int kMost = 16;
  struct Slot {
    std::mutex mutex;  // of `owner` and `session`
    std::string owner;
    std::optional<StudioSession> session;
  };
  struct Entry {
    std::string id;
    int64_t used = 0;
  };

  const Settings settings_;
  std::array<Slot, kMost> slots_;
  std::mutex table_mutex_;  // of the following
  std::array<Entry, kMost> table_;
  int64_t clock_ = 0;
};

}  // namespace retarget::studio
