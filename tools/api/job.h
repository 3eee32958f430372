// What a request asks for, read: clips on one rate, the template.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/load_clip.h"
#include "tools/api/clip_fit.h"
#include "tools/api/retarget.h"

namespace retarget::api {

struct Job {
  Request request;
  std::string template_text;
  std::array<io::LoadedClip, 2> clip;
  solver::RetargetInput input;
  FrameRange frames;
  JobFit fit;
};

Job LoadJob(const Request& request);  // throws InputError

// What Request::also may ask for.
inline const std::vector<std::string> kAlso = {"npz", "csv"};

// The names of the files that will be made of it (Result::files).
std::vector<std::string> OutputNames(const Job& job);
// The files that a request reads, none of which it may overwrite.
std::vector<std::string> InputPaths(const Request& request);

// Frames that stand before the motion on a clip's own rig: 1 for a T-pose, else 0.
int RestFramesOf(const Job& job, int f);

// What was recognised in each clip, a line each with notes, and how the clips fit the template. The
// start of Result::notes.
std::vector<std::string> RecognitionNotes(const Job& job);

// The rest of Run.
Result RunJob(const Job& job, const Progress& progress);

// Throws InputError where CharacterScene will: nobody wants to wait for a solve to hear it.
void CheckCharacters(const Job& job);

// The scene of the solved motion with the glTF characters of the clips in place of their figures;
// what had to be left out of them is added to `notes`.
std::string CharacterScene(const Job& job, const solver::RetargetResult& result,
                           const std::string& scene, std::vector<std::string>* notes);

// A scene file of two motions of the scene's bodies.
std::string SceneBytes(const solver::Scene& scene, const std::array<Clip, 2>& clips);

}  // namespace retarget::api
