#include "tools/api/job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/files.h"
#include "io/scene/character_scene.h"
#include "io/scene/scene_glb.h"
#include "io/template_file.h"
#include "io/text/read_file.h"
#include "model/rig/write_back.h"
#include "tools/api/version.h"
#include "tools/report/report.h"

namespace retarget::api {
namespace {

// The request's frames, or all.
FrameRange CheckedFrames(const Request& request, int available) {
  const std::optional<FrameRange>& frames = request.frames;
  const std::string& word = request.words.frames;
  if (!frames) return {0, available};
  if (frames->first < 0 || frames->last <= frames->first) {
    throw InputError(
        fmt::format("{} {}:{}: expected i:j with 0 <= i < j", word, frames->first, frames->last));
  }
  if (frames->last > available) {
    throw InputError(
        fmt::format("{} {}:{}: the clips have {} common output frames from their starts", word,
                    frames->first, frames->last, available));
  }
  return *frames;
}

// `motion`: of the scene's bodies, from its first frame on; `scene`: its file.
std::string ShowCharacters(const Job& job, const std::array<Clip, 2>& motion,
                           const std::array<solver::Placement, 2>& placement,
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
      own.frames.push_back(WrittenFrame(
          *clip.binding, SampleRig(clip.file.motion, time),
          [&](const Pose& pose) { return solver::Placed(pose, placement[f]); },
          motion[f].frames[t]));
    }
    scaled[f] = io::ScaleGltf(*gltf, own, clip.binding->stature_ratio());
    character[f] = {&scaled[f].clip, &scaled[f].motion};
    shown[f] = &character[f];
  }
  return io::FormatCharacterScene(scene, shown, notes);
}

void CheckAlso(const Request& request) {
  for (const std::string& kind : request.also) {
    if (std::find(kAlso.begin(), kAlso.end(), kind) == kAlso.end()) {
      throw InputError(fmt::format("{} {}: expected some of {}", request.words.also, kind,
                                   fmt::join(kAlso, ", ")));
    }
    if (std::count(request.also.begin(), request.also.end(), kind) > 1) {
      throw InputError(fmt::format("{} {}: is given twice", request.words.also, kind));
    }
  }
}

std::string SceneBytes(const std::array<Body, 2>& body, const std::array<Clip, 2>& clips) {
  return io::FormatSceneGlb(
      {{"a", &body[0], &clips[0], io::kColourA}, {"b", &body[1], &clips[1], io::kColourB}},
      kGenerator);
}

}  // namespace

std::vector<std::string> InputPaths(const Request& request) {
  std::vector<std::string> paths;
  if (request.template_text.empty()) paths.push_back(request.template_path);
  for (const io::ClipOptions& clip : request.clip) {
    if (!clip.bytes.empty()) continue;
    for (const std::string& text : {clip.path, clip.character}) {
      const io::ClipPath path = io::ParseClipPath(text);
      paths.push_back(path.path);
      if (!path.skeleton.empty()) paths.push_back(path.skeleton);
    }
  }
  return paths;
}

Job LoadJob(const Request& request) {
  CheckAlso(request);
  Job job;
  job.request = request;
  for (io::ClipOptions& clip : job.request.clip) clip.bytes = clip.skeleton_bytes = "";
  job.template_text =
      request.template_text.empty() ? io::ReadFile(request.template_path) : request.template_text;
  job.input.posture = io::ParseTemplate(job.template_text, request.template_path);
  double common = 1e300;
  for (int f = 0; f < 2; ++f) {
    job.clip[f] = io::LoadClip(request.clip[f]);
    common = std::min(common, job.clip[f].duration() - request.clip[f].start);
  }
  const auto is_gltf = [](const io::LoadedClip& clip) { return clip.file.format == "glTF"; };
  if (request.show == Show::kCharacters && !is_gltf(job.clip[0]) && !is_gltf(job.clip[1])) {
    throw InputError(request.words.show +
                     " characters: neither clip is, or is put on, a glTF character");
  }
  if (request.rest == Rest::kTPose && RestFramesOf(job, 0) + RestFramesOf(job, 1) == 0) {
    throw InputError(request.words.rest + " t-pose: neither clip is, or is put on, a BVH file");
  }
  const int available = static_cast<int>(std::floor(common * request.fps + 1e-3)) + 1;
  job.frames = CheckedFrames(request, available);
  for (int f = 0; f < 2; ++f) {
    job.input.body[f] = job.clip[f].body;
    job.input.clip[f] = job.clip[f].Resampled(request.fps, job.frames.first, job.frames.last);
    job.input.locked_axes[f] =
        job.clip[f].LockedAxes(request.fps, job.frames.first, job.frames.last);
  }
  const double at = std::round(request.template_at * request.fps) - job.frames.first;
  if (at < 0 || at >= job.frames.last - job.frames.first) {
    throw InputError(fmt::format(
        "{} {}: lies outside the solved frames ({:.3f} to {:.3f} s)", request.words.template_at,
        request.template_at, job.frames.first / request.fps, (job.frames.last - 1) / request.fps));
  }
  job.input.template_frame = static_cast<int>(at);
  job.fit = FitOfJob(job.input, job.clip, request.settings.tangle, job.frames.first / request.fps,
                     request.words.template_at);
  return job;
}

int RestFramesOf(const Job& job, int f) {
  return job.request.rest == Rest::kTPose && job.clip[f].file.format == "BVH" ? 1 : 0;
}

std::vector<std::string> RecognitionNotes(const Job& job) {
  std::vector<std::string> notes;
  for (int f = 0; f < 2; ++f) {
    const io::LoadedClip& clip = job.clip[f];
    const RigFacts& facts = clip.facts;
    notes.push_back(fmt::format("clip {}: {}, profile {}, {} up {}, stature {:.2f} m",
                                report::kFigure[f], clip.options.path, facts.map.profile,
                                facts.unit_name, facts.up, job.input.body[f].stature));
    if (!clip.options.character.empty()) {
      notes.push_back(fmt::format("  on {}{}", clip.options.character,
                                  clip.skin_radii ? ", capsules as wide as its skin" : ""));
    }
    for (const std::string& note : facts.notes) notes.push_back("  note: " + note);
    if (job.request.rest == Rest::kTPose) {
      notes.push_back(RestFramesOf(job, f) > 0
                          ? "  written with a T-pose as frame 0, the motion from frame 1 on"
                          : "  " + job.request.words.rest +
                                " t-pose: no BVH, written with its own rest pose");
    }
  }
  for (const std::string& warning : job.fit.warnings) notes.push_back("warning: " + warning);
  return notes;
}

std::vector<std::string> OutputNames(const Job& job) {
  std::vector<std::string> names = {"scene.glb",   "source.glb",  "baseline.glb",
                                    "report.json", "config.yaml", "certificate.json"};
  if (job.request.page) names.push_back("report.html");
  for (const std::string& kind : job.request.also) names.push_back("scene." + kind);
  for (int f = 0; f < 2; ++f) {
    for (const std::string& name : io::NamesOfClipFile(job.clip[f].file, report::kFigure[f])) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

void CheckCharacters(const Job& job) {
  std::array<Clip, 2> first = job.input.clip;
  for (Clip& clip : first) clip.frames.resize(1);
  ShowCharacters(job, first, {}, SceneBytes(job.input.body, first), nullptr);
}

std::string CharacterScene(const Job& job, const solver::RetargetResult& result,
                           const std::string& scene, std::vector<std::string>* notes) {
  return ShowCharacters(job, result.solved, result.placement, scene, notes);
}

std::string SceneBytes(const solver::Scene& scene, const std::array<Clip, 2>& clips) {
  return SceneBytes(scene.body, clips);
}

}  // namespace retarget::api
