// ReadGltf and ParseGltf of io/gltf/clip.h.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "io/gltf/character.h"
#include "io/gltf/clip.h"
#include "io/gltf/mesh.h"
#include "io/gltf/skeleton.h"
#include "io/gltf/tracks.h"
#include "io/gltf/vrm.h"
#include "io/text/quoted.h"
#include "io/text/read_file.h"
#include "model/rig/tree.h"

namespace retarget::io {
namespace {

// A bound that no real file reaches, so that a damaged one cannot ask for all memory.
constexpr size_t kMostJointFrames = 20'000'000;

// The selected animation, or -1 where the file has none. `first`: of several, none of them
// selected, the format means the first.
int ChooseAnimation(const tinygltf::Model& model, const GltfSelect& wanted, bool first,
                    const std::string& name, std::vector<std::string>* notes) {
  const std::string& select = wanted.animation;
  const std::vector<tinygltf::Animation>& animations = model.animations;
  constexpr size_t kShown = 12;
  std::string list;
  for (size_t a = 0; a < std::min(kShown, animations.size()); ++a) {
    list += fmt::format("{}{} {}", a > 0 ? ", " : "", a, Quoted(animations[a].name));
  }
  if (animations.size() > kShown) list += ", ...";
  if (select.empty()) {
    if (animations.size() > 1 && !wanted.any_animation && !first) {
      throw InputError(
          fmt::format("{}: {} animations, select one: {}", name, animations.size(), list));
    }
    if (animations.size() > 1) {
      notes->push_back(
          fmt::format("{} animations, the first is taken: {}", animations.size(), list));
      return 0;
    }
    return static_cast<int>(animations.size()) - 1;
  }
  for (size_t a = 0; a < animations.size(); ++a) {
    if (animations[a].name == select) return static_cast<int>(a);
  }
  for (size_t a = 0; a < animations.size(); ++a) {
    if (std::to_string(a) == select) return static_cast<int>(a);
  }
  throw InputError(
      fmt::format("{}: no animation {}, expected {}", name, Quoted(select),
                  animations.empty() ? "none: the file has no animation" : "one of " + list));
}

const GltfTrack* Find(const std::map<int, GltfTrack>& tracks, int node) {
  const auto it = tracks.find(node);
  return it == tracks.end() ? nullptr : &it->second;
}

// Fills frames and key times.
void SampleTracks(const GltfTracks& tracks, GltfClip* clip) {
  std::vector<const GltfTrack*> translation, rotation, scale, used;
  bool rigid = true;
  for (const GltfJoint& joint : clip->joints) {
    translation.push_back(Find(tracks.translation, joint.node));
    rotation.push_back(Find(tracks.rotation, joint.node));
    scale.push_back(joint.changes_scale ? Find(tracks.scale, joint.node) : nullptr);
    for (const GltfTrack* track : {translation.back(), rotation.back(), scale.back()}) {
      if (track != nullptr) used.push_back(track);
    }
    constexpr double kRounding = 1e-5;
    const double left = (joint.scale.array() - joint.size).abs().maxCoeff();
    rigid = rigid && !joint.changes_scale && left <= kRounding * joint.size;
  }
  FrameTimes frames = ChooseFrameTimes(used, clip->name);
  if (frames.times.size() * clip->joints.size() > kMostJointFrames) {
    throw InputError(fmt::format("{}: {} frames of {} joints are too many", clip->name,
                                 frames.times.size(), clip->joints.size()));
  }
  clip->motion.frame_time = frames.frame_time;
  for (const double time : frames.times) {
    RigFrame frame;
    for (size_t j = 0; j < clip->joints.size(); ++j) {
      const GltfJoint& joint = clip->joints[j];
      const Vec3 t = translation[j] ? translation[j]->Translation(time) : joint.rest_translation;
      const Quat q = rotation[j] ? rotation[j]->Rotation(time) : joint.rest_rotation;
      frame.translation.push_back(joint.origin + joint.turn * joint.stretch.cwiseProduct(t));
      frame.rotation.push_back((joint.turn * q).normalized());
      if (!rigid) {
        const Vec3 s = scale[j] ? scale[j]->Translation(time) : joint.scale;
        frame.scale.push_back(s / joint.size);
      }
      // Tame numbers can multiply to wild ones.
      if (!frame.translation.back().allFinite()) {
        throw InputError(fmt::format("{}: joint {} leaves all bounds", clip->name,
                                     Quoted(clip->motion.rig.joints[j].name)));
      }
    }
    clip->motion.frames.push_back(std::move(frame));
  }
  if (frames.are_keys) clip->key_times = std::move(frames.times);
}

bool SharesJoint(const tinygltf::Model& model, const std::vector<int>& skins,
                 const std::vector<int>& nodes) {
  for (const int skin : skins) {
    const std::vector<int>& joints = model.skins[skin].joints;
    if (std::find_first_of(nodes.begin(), nodes.end(), joints.begin(), joints.end()) !=
        nodes.end()) {
      return true;
    }
  }
  return false;
}

void CheckFinite(const GltfClip& clip) {
  for (const RigJoint& joint : clip.motion.rig.joints) {
    if (!joint.offset.allFinite() || !joint.rest_rotation.coeffs().allFinite()) {
      throw InputError(
          fmt::format("{}: joint {} leaves all bounds", clip.name, Quoted(joint.name)));
    }
  }
}

}  // namespace

GltfClip ParseGltf(std::string bytes, const std::string& name, const std::string& folder,
                   const GltfSelect& select) {
  const LoadedGltf gltf = LoadGltf(bytes, name, folder);
  GltfClip clip;
  clip.bytes = std::move(bytes);
  clip.name = name;
  clip.folder = folder;
  const tinygltf::Model& model = gltf.model;
  VrmBones bones = ReadVrmBones(gltf.extensions, static_cast<int>(model.nodes.size()), name);
  std::vector<int> humanoid;
  for (const auto& [bone, node] : bones.node) humanoid.push_back(node);

  GltfAccessors accessors(model, clip.name);
  // Of a bare skeleton the animation tells what the joints are, even where it is not played.
  const bool any = select.at_rest && select.animation.empty() && !model.animations.empty();
  const int animation =
      any ? 0 : ChooseAnimation(model, select, bones.is_animation, name, &clip.notes);
  GltfTracks tracks;
  if (animation >= 0 && !(select.at_rest && !model.skins.empty())) {
    if (!select.at_rest) clip.animation = model.animations[animation].name;
    tracks = ReadTracks(model.animations[animation], &accessors, clip.name, &clip.notes);
  }
  const std::vector<int> skins = CharacterSkins(gltf, select, humanoid, name);
  if ((!select.skin.empty() || !select.figure.empty()) && !skins.empty() &&
      !SharesJoint(model, skins, humanoid)) {
    humanoid.clear();  // somebody else was selected
    bones = VrmBones();
  }
  clip.skins = skins;
  clip.is_one_of_several = !skins.empty() && skins.size() < model.skins.size();
  BuildSkeleton(gltf, skins, humanoid, tracks, &accessors, &clip);
  if (clip.joints.empty()) {
    throw InputError(name + (animation < 0 ? ": no skin and no animation, expected a character"
                                           : ": no skin, and the animation moves no node"));
  }
  CheckFinite(clip);
  SampleTracks(select.at_rest ? GltfTracks() : tracks, &clip);
  if (!bones.node.empty()) {
    std::vector<int> joint_of_node(model.nodes.size(), -1);
    for (size_t j = 0; j < clip.joints.size(); ++j) {
      joint_of_node[clip.joints[j].node] = static_cast<int>(j);
    }
    clip.map = MapOfVrmBones(bones, joint_of_node);
    clip.faces_minus_z = bones.faces_minus_z;
  }
  FindSkinTops(gltf, &clip);
  return clip;
}

GltfClip CutGltf(const GltfClip& clip, const std::vector<int>& joints) {
  GltfClip out = clip;
  out.motion = MotionOfJoints(clip.motion, joints);
  out.joints.clear();
  for (const int j : joints) out.joints.push_back(clip.joints[j]);
  out.map.reset();  // of the file's one human, which has no others beside it
  return out;
}

GltfClip ReadGltf(const std::string& path, const GltfSelect& select) {
  const std::string folder = std::filesystem::path(path).parent_path();
  return ParseGltf(ReadFile(path, "a glTF file"), path, folder.empty() ? "." : folder, select);
}

}  // namespace retarget::io
