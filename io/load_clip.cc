#include "io/load_clip.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/clip_repair.h"
#include "io/files.h"
#include "io/map_file.h"
#include "io/text/quoted.h"
#include "model/rig/tree.h"

namespace retarget::io {
namespace {

// A measured capsule is believed between these shares of the tabulated one.
constexpr double kThinnest = 0.6, kThickest = 1.5;

LoadedClip ReadClip(const ClipOptions& options) {
  LoadedClip clip;
  clip.options = options;
  const bool in_memory = !options.bytes.empty();
  ClipPath path = in_memory ? ParseClipName(options.path, !options.skeleton_bytes.empty())
                            : ParseClipPath(options.path);
  path.select.any_animation = options.any_animation;
  clip.file = in_memory
                  ? ParseClipFile(path, options.bytes, options.skeleton_bytes, options.amc_fps)
                  : ReadClipFile(path, options.amc_fps);
  clip.options.bytes.clear();  // the file has them
  clip.options.skeleton_bytes.clear();
  clip.hash = HashOf(clip.file.bytes);
  return clip;
}

// What the options, the map file and the format say, in this order.
RecogniseOptions RecogniseOptionsOf(const ClipOptions& options, const ClipFile& file) {
  RecogniseOptions recognise{file.metres_per_unit, file.up, file.map, options.words,
                             options.stature};
  if (!options.map.empty()) {
    MapFile map = ReadMap(options.map, file.motion.rig);
    if (map.metres_per_unit) recognise.metres_per_unit = map.metres_per_unit;
    if (map.up) recognise.up = map.up;
    recognise.map = std::move(map.map);
  }
  if (!options.units.empty()) {
    recognise.metres_per_unit = ParseUnits(options.units);
    if (!recognise.metres_per_unit) {
      throw InputError(fmt::format("{} {}: expected cm, m, mm, dm, in, cmu or metres per unit",
                                   options.Named(options.words.units), options.units));
    }
  }
  if (!options.up.empty()) recognise.up = options.up[0];
  if (options.ik_targets != "follow" && options.ik_targets != "keep") {
    throw InputError(fmt::format("{} {}: expected follow or keep",
                                 options.Named(options.words.ik_targets), options.ik_targets));
  }
  return recognise;
}

std::string FigureNote(const std::vector<std::string>& figures) {
  std::string list;
  for (size_t n = 0; n < figures.size(); ++n) {
    list += fmt::format("{}{} {}", n > 0 ? ", " : "", n, Quoted(figures[n]));
  }
  return fmt::format(
      "the file holds {} figures, {}: the first one is read; #figure=1 after its name selects the "
      "next",
      figures.size(), list);
}

// Recognises the first of several figures, in the joints of all.
RigFacts RecogniseFile(const ClipFile& file, const RecogniseOptions& options,
                       const std::string& name) {
  if (file.figure_joints.empty() || options.map) return Recognise(file.motion, options, name);
  const std::vector<int>& joints = file.figure_joints;
  RigFacts facts = Recognise(MotionOfJoints(file.motion, joints), options, name);
  VisitJoints(&facts.map, [&](int* joint) {
    if (*joint >= 0) *joint = joints[static_cast<size_t>(*joint)];
  });
  facts.notes.insert(facts.notes.begin(), FigureNote(file.figures));
  return facts;
}

void Bind(LoadedClip* clip) {
  if (clip->options.ik_targets == "keep") clip->facts.followers.clear();
  const int chest = ChestBone(clip->file.motion, clip->facts.map);
  try {
    clip->binding =
        std::make_unique<RigBinding>(clip->file.motion, clip->facts, chest, clip->options.stature);
  } catch (const InputError& error) {
    throw InputError(clip->options.path + ": " + error.what());
  }
  clip->body = clip->binding->body();
}

// Capsule radii from the skin of a glTF character: of every segment the radius of the bone that it
// lies along.
void TakeRadiiFromSkin(LoadedClip* clip) {
  const auto* gltf = std::get_if<GltfClip>(&clip->file.original);
  if (gltf == nullptr) return;
  const std::vector<double> radii = BoneRadii(*gltf);
  const RigBinding& binding = *clip->binding;
  for (int n = 1; n < clip->body.num_nodes(); ++n) {
    Node& node = clip->body.nodes[n];
    const int bone = binding.JointAtNode(node.parent);
    // The pelvis' skin is round the hips, not round the lines to the legs.
    if (bone < 0 || node.link == 0 || radii[bone] <= 0) continue;
    node.radius = std::clamp(radii[bone] * binding.stature_ratio(), kThinnest * node.radius,
                             kThickest * node.radius);
    clip->skin_radii = true;
  }
}

double LegLength(const Body& body) {
  double sum = 0;
  for (const char* side : {"left", "right"}) {
    for (const char* node : {"_knee", "_ankle"}) {
      sum += body.SegmentLength(body.FindNode(side + std::string(node)));
    }
  }
  return sum / 2;
}

// The character with the motion of `clip`.
LoadedClip OnCharacter(LoadedClip clip) {
  LoadedClip hero;
  hero.options = clip.options;
  ClipPath path = ParseClipPath(clip.options.character);
  path.select.at_rest = true;
  hero.file = ReadClipFile(path);
  hero.hash = HashOf(hero.file.bytes);
  hero.motion_hash = clip.hash;
  hero.motion_facts = clip.facts;
  ClipOptions options = clip.options;
  options.path = clip.options.character;
  options.map = clip.options.character_map;
  options.units = options.up = "";
  RigMotion& motion = hero.file.motion;
  motion.frames.resize(1);
  hero.facts = RecogniseFile(hero.file, RecogniseOptionsOf(options, hero.file), options.path);
  hero.facts.notes.insert(hero.facts.notes.begin(), hero.file.notes.begin(), hero.file.notes.end());
  hero.options.path = options.path;
  Bind(&hero);
  hero.options.path = clip.options.path;

  const RigFrame rest = motion.frames[0];
  const double scale = LegLength(hero.body) / LegLength(clip.body);
  motion.frames.clear();
  motion.frame_time = clip.file.motion.frame_time;
  for (const RigFrame& frame : clip.file.motion.frames) {
    Pose pose = clip.binding->PoseOf(frame);
    pose.root_position *= scale;
    RigFrame applied = hero.binding->Apply(rest, pose);
    // As a file of the character's own size would have it.
    for (Vec3& t : applied.translation) t /= hero.binding->stature_ratio();
    motion.frames.push_back(std::move(applied));
  }
  // The keys are no longer those of an animation that the file may have.
  if (auto* gltf = std::get_if<GltfClip>(&hero.file.original)) gltf->key_times.clear();
  return hero;
}

}  // namespace

Clip LoadedClip::Resampled(double fps, int first, int last) const {
  Clip clip;
  clip.fps = fps;
  for (int k = first; k < last; ++k) {
    clip.frames.push_back(binding->PoseOf(SampleRig(file.motion, options.start + k / fps)));
  }
  return clip;
}

std::vector<std::vector<LockedAxis>> LoadedClip::LockedAxes(double fps, int first, int last) const {
  std::vector<std::vector<LockedAxis>> locked_axes;
  bool any = false;
  for (int k = first; k < last; ++k) {
    locked_axes.push_back(binding->LockedAxesOf(SampleRig(file.motion, options.start + k / fps)));
    any = any || !locked_axes.back().empty();
  }
  return any ? locked_axes : std::vector<std::vector<LockedAxis>>();
}

std::string MapOfClip(const ClipOptions& options) {
  const ClipFile file = ReadClip(options).file;
  const RecogniseOptions recognise = RecogniseOptionsOf(options, file);
  try {
    return FormatMap(file.motion, RecogniseFile(file, recognise, options.path));
  } catch (const InputError& refusal) {
    return FormatMapDraft(file.motion, refusal.what());
  }
}

LoadedClip RecogniseClip(const ClipOptions& options) {
  LoadedClip clip = ReadClip(options);
  RigMotion& motion = clip.file.motion;
  clip.facts = RecogniseFile(clip.file, RecogniseOptionsOf(options, clip.file), options.path);
  clip.facts.notes.insert(clip.facts.notes.begin(), clip.file.notes.begin(), clip.file.notes.end());
  if (options.skip_frames >= motion.num_frames()) {
    throw InputError(fmt::format("{} {}: {} has only {} frames",
                                 options.Named(options.words.skip_frames), options.skip_frames,
                                 options.path, motion.num_frames()));
  }
  motion.frames.erase(motion.frames.begin(), motion.frames.begin() + options.skip_frames);
  TreatJumps(&clip);
  return clip;
}

LoadedClip LoadClip(const ClipOptions& options) {
  ClipOptions own = options;
  if (!options.character.empty()) own.stature = 0;  // the character's is meant
  LoadedClip clip = RecogniseClip(own);
  if (!clip.file.has_motion) {
    throw InputError(fmt::format(
        "{}: is a character without animation, expected a motion; to put another clip's motion on "
        "it: {} {}",
        options.path, options.Named(options.words.character), options.path));
  }
  Bind(&clip);
  RecoverTravel(&clip);
  if (options.start > clip.duration() + 1e-9) {
    throw InputError(fmt::format("{} {}: {} is only {:.3f} s long",
                                 options.Named(options.words.start), options.start, options.path,
                                 clip.duration()));
  }
  if (!options.character.empty()) {
    clip.options.stature = options.stature;
    clip = OnCharacter(std::move(clip));
  }
  TakeRadiiFromSkin(&clip);
  return clip;
}

}  // namespace retarget::io
