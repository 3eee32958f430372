// What the studio answers to each request; knows sessions and library, but no HTTP.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "tools/studio/clips.h"
#include "tools/studio/jobs.h"
#include "tools/studio/library.h"
#include "tools/studio/sessions.h"

namespace retarget::studio {

struct StudioRequest {
  std::string method, path;  // "POST", "/api/do"
  std::map<std::string, std::string> parameters;
  std::string body;
};

struct StudioAnswer {
  int status = 200;
  std::string type = "application/json; charset=utf-8";
  std::string body;
  // Where the answer comes bit by bit: appends what is new, waiting for it up to a second; false:
  // that was the last.
  std::function<bool(std::string*)> more = nullptr;
};

// Where the studio starts.
struct StudioStart {
  StudioPosture posture;
  bool has_template = false;
  Settings settings;  // of the sessions' queries
};

class StudioRoutes {
 public:
  StudioRoutes(StudioStart start, StudioLibrary* library, StudioClips* clips, StudioJobs* jobs);

  // Never throws: what cannot be done is answered with {"error": "one sentence"}.
  StudioAnswer Answer(const StudioRequest& request);

 private:
  using Route = std::function<StudioAnswer(const StudioRequest&)>;

  void AddSessionRoutes();
  void AddLibraryRoutes();
  void AddPhotoRoutes();
  void AddSolveRoutes();
  StudioAnswer StartSolve(const StudioRequest& request);
  StudioAnswer AnswerOrThrow(const StudioRequest& request);
  StudioPosture PostureToLoad(const io::Value& fields) const;
  StudioSessions::Locked SessionOf(const StudioRequest& request);

  StudioStart start_;
  StudioLibrary* library_;
  StudioClips* clips_;
  StudioJobs* jobs_;
  StudioSessions sessions_;
  std::map<std::string, Route> routes_;  // by "METHOD path"
};

// {"error": sentence, "reason"?: word}.
StudioAnswer ErrorAnswer(int status, const std::string& sentence, const std::string& reason = "");
// The same for what is thrown.
StudioAnswer AnswerOf(const std::exception& error);

}  // namespace retarget::studio
