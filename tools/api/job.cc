#include "tools/api/job.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "io/scene/character_scene.h"
#include "io/scene/scene_glb.h"
#include "io/settings_file.h"
#include "io/template_file.h"
#include "tools/api/version.h"
#include "tools/report/report.h"

namespace retarget::api {
namespace {

FrameRange ParseFrames(const std::string& text, int available) {
  if (text.empty()) return {0, available};
  int first = 0, last = 0, read = 0;
  const bool parsed = std::sscanf(text.c_str(), "%d:%d%n", &first, &last, &read) == 2 &&
                      read == static_cast<int>(text.size());
  if (!parsed || first < 0 || last <= first) {
    throw InputError(fmt::format("--frames {}: expected i:j with 0 <= i < j", text));
  }
  if (last > available) {
    throw InputError(fmt::format(
        "--frames {}: the clips have {} common output frames from their starts", text, available));
  }
  return {first, last};
}

}  // namespace

Settings SettingsOf(const SettingsOptions& options) {
  Settings settings =
      options.config_path.empty() ? Settings{} : io::ReadSettings(options.config_path);
  for (const std::string& assignment : options.set) io::SetByName(&settings, assignment);
  return settings;
}

Settings EffectiveSettings(const RetargetOptions& options) {
  Settings settings = SettingsOf({options.config_path, options.set});
  if (options.threads >= 0) settings.solve.threads = options.threads;
  solver::ParseStages(settings.solve.stages);
  return settings;
}

std::vector<std::string> InputPaths(const RetargetOptions& options) {
  std::vector<std::string> paths = {options.template_path};
  for (const io::ClipOptions& clip : options.clip) {
    for (const std::string& text : {clip.path, clip.character}) {
      const io::ClipPath path = io::ParseClipPath(text);
      paths.push_back(path.path);
      if (!path.skeleton.empty()) paths.push_back(path.skeleton);
    }
  }
  return paths;
}

Job LoadJob(const RetargetOptions& options) {
  Job job;
  job.input.posture = io::ReadTemplate(options.template_path);
  double common = 1e300;
  for (int f = 0; f < 2; ++f) {
    job.clip[f] = io::LoadClip(options.clip[f]);
    common = std::min(common, job.clip[f].duration() - options.clip[f].start);
  }
  const auto is_gltf = [](const io::LoadedClip& clip) { return clip.file.format == "glTF"; };
  if (options.show == "characters" && !is_gltf(job.clip[0]) && !is_gltf(job.clip[1])) {
    throw InputError("--show characters: neither clip is, or is put on, a glTF character");
  }
  const int available = static_cast<int>(std::floor(common * options.fps + 1e-3)) + 1;
  job.frames = ParseFrames(options.frames, available);
  for (int f = 0; f < 2; ++f) {
    job.input.body[f] = job.clip[f].body;
    job.input.clip[f] = job.clip[f].Resampled(options.fps, job.frames.first, job.frames.last);
    job.input.stiff[f] = job.clip[f].StiffTurns(options.fps, job.frames.first, job.frames.last);
  }
  const double at = std::round(options.template_at * options.fps) - job.frames.first;
  if (at < 0 || at >= job.frames.last - job.frames.first) {
    throw InputError(fmt::format(
        "--template-at {}: lies outside the solved frames ({:.3f} to {:.3f} s)",
        options.template_at, job.frames.first / options.fps, (job.frames.last - 1) / options.fps));
  }
  job.input.template_frame = static_cast<int>(at);
  return job;
}

void TellNotes(const Job& job) {
  for (int f = 0; f < 2; ++f) {
    const RigFacts& facts = job.clip[f].facts;
    fmt::print(stderr, "clip {}: {}, profile {}, {} up {}, stature {:.2f} m\n", report::kFigure[f],
               job.clip[f].options.path, facts.map.profile, facts.unit_name, facts.up,
               job.input.body[f].stature);
    if (!job.clip[f].options.character.empty()) {
      fmt::print(stderr, "  on {}{}\n", job.clip[f].options.character,
                 job.clip[f].skin_radii ? ", capsules as wide as its skin" : "");
    }
    for (const std::string& note : facts.notes) fmt::print(stderr, "  note: {}\n", note);
  }
}

namespace {

// `motion`: of the scene's bodies, from its first frame on; `scene`: its file.
std::string ShowCharacters(const Job& job, const std::array<Clip, 2>& motion,
                           const std::string& scene, std::vector<std::string>* notes) {
  std::array<io::ScaledGltf, 2> scaled;
  std::array<io::SceneCharacter, 2> character;
  std::array<const io::SceneCharacter*, 2> shown = {nullptr, nullptr};
  for (int f = 0; f < 2; ++f) {
    const io::LoadedClip& clip = job.clip[f];
    const auto* gltf = std::get_if<io::GltfClip>(&clip.file.original);
    if (gltf == nullptr) continue;
    const double fps = motion[f].fps;
    RigMotion own;
    own.rig = clip.file.motion.rig;
    own.frame_time = 1 / fps;
    for (size_t t = 0; t < motion[f].frames.size(); ++t) {
      const double time = clip.options.start + (job.frames.first + static_cast<double>(t)) / fps;
      own.frames.push_back(
          clip.binding->Apply(SampleRig(clip.file.motion, time), motion[f].frames[t]));
    }
    scaled[f] = io::ScaleGltf(*gltf, own, clip.binding->stature_ratio());
    character[f] = {&scaled[f].clip, &scaled[f].motion};
    shown[f] = &character[f];
  }
  return io::FormatCharacterScene(scene, shown, notes);
}

std::string SceneBytes(const std::array<Body, 2>& body, const std::array<Clip, 2>& clips) {
  return io::FormatSceneGlb(
      {{"a", &body[0], &clips[0], io::kColourA}, {"b", &body[1], &clips[1], io::kColourB}},
      kGenerator);
}

}  // namespace

void CheckCharacters(const Job& job) {
  std::array<Clip, 2> first = job.input.clip;
  for (Clip& clip : first) clip.frames.resize(1);
  ShowCharacters(job, first, SceneBytes(job.input.body, first), nullptr);
}

std::string CharacterScene(const Job& job, const solver::RetargetResult& result,
                           const std::string& scene) {
  std::vector<std::string> notes;
  std::string bytes = ShowCharacters(job, result.solved, scene, &notes);
  for (const std::string& note : notes) fmt::print(stderr, "note: {}\n", note);
  return bytes;
}

std::string SceneBytes(const solver::Scene& scene, const std::array<Clip, 2>& clips) {
  return SceneBytes(scene.body, clips);
}

}  // namespace retarget::api
