// What the command line asks for, read: settings, clips on one rate, the template.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/load_clip.h"
#include "model/settings.h"
#include "solver/retarget.h"
#include "tools/api/options.h"

namespace retarget::api {

struct FrameRange {
  int first, last;  // half-open
};

// Configuration file, then single settings. Throws InputError.
Settings SettingsOf(const SettingsOptions& options);
// The same, then --threads.
Settings EffectiveSettings(const RetargetOptions& options);

struct Job {
  std::array<io::LoadedClip, 2> clip;
  solver::RetargetInput input;
  FrameRange frames;
};

// The files that a run reads, none of which it may overwrite.
std::vector<std::string> InputPaths(const RetargetOptions& options);

Job LoadJob(const RetargetOptions& options);  // throws InputError
// What was recognised in the clips, to stderr.
void TellNotes(const Job& job);

// Throws InputError where CharacterScene will: nobody wants to wait for a solve to hear it.
void CheckCharacters(const Job& job);

// The scene of the solved motion with the glTF characters of the clips in place of their figures.
std::string CharacterScene(const Job& job, const solver::RetargetResult& result,
                           const std::string& scene);

// A scene file of two motions of the scene's bodies.
std::string SceneBytes(const solver::Scene& scene, const std::array<Clip, 2>& clips);

}  // namespace retarget::api
