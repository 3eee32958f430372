#include "io/gltf/skeleton.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "io/gltf/node.h"

namespace retarget::io {
namespace {

using Eigen::Matrix4d;

constexpr double kUniform = 1e-5;  // relative difference of scales that is only rounding

constexpr double kNothing = 1e-12;

double Mean(const Vec3& scale) { return scale.sum() / 3; }

bool IsUniform(const Vec3& scale) {
  return (scale.array() - Mean(scale)).abs().maxCoeff() <= kUniform * std::abs(Mean(scale));
}

class SkeletonBuilder {
 public:
  SkeletonBuilder(const LoadedGltf& gltf, const std::vector<int>& skins, const GltfTracks& tracks,
                  GltfAccessors* accessors, GltfClip* clip)
      : gltf_(gltf), model_(gltf.model), tracks_(tracks), clip_(*clip) {
    for (const int skin : skins) {
      const tinygltf::Skin& s = model_.skins[skin];
      const std::vector<Matrix4d> inverse =
          InverseBindMatrices(model_, skin, accessors, clip->name);
      for (size_t j = 0; j < s.joints.size(); ++j) {
        seeds_.insert(s.joints[j]);
        if (s.inverseBindMatrices >= 0 && std::abs(inverse[j].determinant()) > 1e-18) {
          bind_[s.joints[j]].push_back({skin, inverse[j].inverse()});
        }
      }
    }
  }

  void Build(const std::vector<int>& humanoid) {
    seeds_.insert(humanoid.begin(), humanoid.end());
    const bool bare = seeds_.empty();
    Choose(bare);
    const size_t count = model_.nodes.size();
    joint_of_node_.assign(count, -1);
    frame_.resize(count);
    for (const int n : gltf_.order) {
      if (chosen_[n]) {
        AddJoint(n);
      } else if (leads_[n]) {
        frame_[n] = FrameBelow(n);
      }
    }
    NameJoints();
    NoteScales();
  }

 private:
  // How what hangs from a node is laid into the rig: p = origin + turn (stretch .* t).
  struct Frame {
    Vec3 origin = Vec3::Zero();
    Quat turn = Quat::Identity();
    Vec3 stretch = Vec3::Ones();
  };
  struct Bind {
    int skin;
    Matrix4d matrix;
  };

  bool IsMoved(int node) const {
    return tracks_.translation.contains(node) || tracks_.rotation.contains(node);
  }

  // Whether a node's scale changes in the animation.
  bool ChangesScale(int node) const {
    const auto track = tracks_.scale.find(node);
    return track != tracks_.scale.end() && !track->second.IsConstant(kUniform);
  }

  // Whether a node does to what hangs from it more than move, turn and enlarge it for good.
  bool HasShape(int node) const {
    const GltfTransform own = TransformOf(model_, node, clip_.name);
    return ChangesScale(node) || !IsUniform(ScaleOf(node, own.scale));
  }

  // The seeds (without any: what is moved), nodes above and below them that are moved or scaled
  // unevenly, all between, and the meshless branches below.
  void Choose(bool bare) {
    const size_t count = model_.nodes.size();
    std::vector<bool> has_mesh(count), below(count);
    leads_.assign(count, false);
    chosen_.assign(count, false);
    for (auto it = gltf_.order.rbegin(); it != gltf_.order.rend(); ++it) {
      const int n = *it, parent = gltf_.parent[n];
      const bool seed = bare ? IsMoved(n) : seeds_.contains(n);
      leads_[n] = leads_[n] || seed;
      has_mesh[n] = has_mesh[n] || model_.nodes[n].mesh >= 0;
      chosen_[n] = seed || (leads_[n] && (IsMoved(n) || HasShape(n)));
      if (parent < 0) continue;
      leads_[parent] = leads_[parent] || leads_[n];
      has_mesh[parent] = has_mesh[parent] || has_mesh[n];
    }
    for (const int n : gltf_.order) {
      const int parent = gltf_.parent[n];
      below[n] = parent >= 0 && (below[parent] || chosen_[parent]);
    }
    if (!bare) ChooseBeside(has_mesh);
    std::vector<bool> carries = leads_;  // a seed or something that moves
    for (auto it = gltf_.order.rbegin(); it != gltf_.order.rend(); ++it) {
      const int n = *it, parent = gltf_.parent[n];
      carries[n] = carries[n] || (below[n] && IsMoved(n));
      if (below[n] && (carries[n] || !has_mesh[n])) chosen_[n] = true;
      if (parent >= 0) carries[parent] = carries[parent] || carries[n];
    }
  }

  // What hangs beside a root from the same armature and carries no mesh: targets of inverse
  // kinematics and the like. Another character's bones do not.
  void ChooseBeside(const std::vector<bool>& has_mesh) {
    const size_t count = model_.nodes.size();
    std::vector<bool> foreign(count), armature(count);
    for (const tinygltf::Skin& skin : model_.skins) {
      for (const int joint : skin.joints) foreign[joint] = !seeds_.contains(joint);
    }
    for (auto it = gltf_.order.rbegin(); it != gltf_.order.rend(); ++it) {
      const int n = *it, parent = gltf_.parent[n];
      foreign[n] = foreign[n] || model_.nodes[n].camera >= 0;
      if (parent < 0) continue;
      foreign[parent] = foreign[parent] || foreign[n];
      armature[parent] = armature[parent] || (chosen_[n] && !chosen_[parent]);
    }
    std::vector<bool> beside(count);
    for (const int n : gltf_.order) {
      const int parent = gltf_.parent[n];
      if (parent < 0) continue;
      beside[n] = beside[parent] || (armature[parent] && !leads_[n] && !has_mesh[n] && !foreign[n]);
      chosen_[n] = chosen_[n] || beside[n];
    }
  }

  void AddJoint(int n) {
    const int up = gltf_.parent[n];
    const int parent = up >= 0 ? joint_of_node_[up] : -1;
    joint_of_node_[n] = clip_.motion.rig.num_joints();
    const GltfTransform own = TransformOf(model_, n, clip_.name);
    GltfJoint joint;
    joint.node = n;
    joint.rest_translation = own.translation;
    joint.rest_rotation = own.rotation;
    joint.rest_scale = own.scale;
    joint.scale = ScaleOf(n, own.scale);
    joint.changes_scale = ChangesScale(n);
    // What is left of the scale, uneven or of a frame, is in the frames.
    joint.size = Mean(joint.scale) > kNothing ? Mean(joint.scale) : 1;
    joint.has_translation_track = tracks_.translation.contains(n);
    if (parent >= 0) {
      joint.stretch = clip_.joints[parent].size * clip_.joints[parent].stretch;
    } else if (up >= 0) {
      joint.origin = frame_[up].origin;
      joint.turn = frame_[up].turn;
      joint.stretch = frame_[up].stretch;
    }
    RigJoint out;
    out.name = model_.nodes[n].name;
    out.parent = parent;
    out.translates = joint.has_translation_track;
    out.can_translate = true;
    const GltfTransform rest = Rest(n, parent, own);
    out.offset = joint.origin + joint.turn * joint.stretch.cwiseProduct(rest.translation);
    out.rest_rotation = (joint.turn * rest.rotation).normalized();
    clip_.motion.rig.joints.push_back(out);
    clip_.joints.push_back(joint);
  }

  // Of a node above the roots, which is folded into them.
  Frame FrameBelow(int n) {
    const int up = gltf_.parent[n];
    const Frame above = up >= 0 ? frame_[up] : Frame();
    const GltfTransform t = TransformOf(model_, n, clip_.name);
    Frame out;
    out.origin = above.origin + above.turn * above.stretch.cwiseProduct(t.translation);
    out.turn = (above.turn * t.rotation).normalized();
    out.stretch = Mean(ScaleOf(n, t.scale)) * above.stretch;
    return out;
  }

  // At the beginning of the animation: the track's first, else the node's own.
  Vec3 ScaleOf(int n, const Vec3& own) const {
    const auto track = tracks_.scale.find(n);
    const bool animated = track != tracks_.scale.end();
    const Vec3 scale = animated ? Vec3(Vec3::Map(track->second.Key(0))) : own;
    double least = scale.minCoeff();
    for (size_t k = 0; animated && k < track->second.times.size(); ++k) {
      least = std::min(least, Vec3(Vec3::Map(track->second.Key(k))).minCoeff());
    }
    if (least < 0) {
      throw InputError(
          fmt::format("{}: nodes[{}]: a negative scale mirrors the rig below it", clip_.name, n));
    }
    return scale;
  }

  // The pose that the skin was bound in, where it is known and differs from the nodes' own: a file
  // may show its character in any other pose.
  GltfTransform Rest(int n, int parent, const GltfTransform& own) {
    constexpr double kTurned = 0.1 * kDegree, kMoved = 1e-3;  // rad, share of the length
    if (parent < 0 || !bind_.contains(gltf_.parent[n])) return own;
    const std::vector<Bind>& above = bind_[gltf_.parent[n]];
    if (!bind_.contains(n)) {
      for (const Bind& bind : above) {
        bind_[n].push_back({bind.skin, bind.matrix * MatrixOf(own)});
      }
      return own;
    }
    // Skins may have been bound in different spaces: both matrices must be of one.
    const std::vector<Bind>& at = bind_[n];
    const auto upper =
        std::find_first_of(above.begin(), above.end(), at.begin(), at.end(),
                           [](const Bind& a, const Bind& b) { return a.skin == b.skin; });
    if (upper == above.end()) return own;
    const auto lower = std::find_if(at.begin(), at.end(),
                                    [&](const Bind& bind) { return bind.skin == upper->skin; });
    const Matrix4d local = upper->matrix.inverse() * lower->matrix;
    Mat3 axes = local.topLeftCorner<3, 3>();
    for (int c = 0; c < 3; ++c) {
      if (!(axes.col(c).norm() > 1e-9)) return own;
      axes.col(c).normalize();
    }
    constexpr double kSquare = 0.01;
    const double skew = (axes.transpose() * axes - Mat3::Identity()).cwiseAbs().maxCoeff();
    if (!(skew < kSquare) || axes.determinant() < 0) return own;
    GltfTransform bound = own;
    bound.translation = local.topRightCorner<3, 1>();
    bound.rotation = Quat(axes).normalized();
    if (!bound.translation.allFinite()) return own;
    const bool same = bound.rotation.angularDistance(own.rotation) < kTurned &&
                      (bound.translation - own.translation).norm() <=
                          kMoved * std::max(own.translation.norm(), bound.translation.norm());
    return same ? own : bound;
  }

  // Nameless joints get their node's index for a name, and so do later ones of the same name.
  void NameJoints() {
    std::set<std::string> taken;
    for (const RigJoint& joint : clip_.motion.rig.joints) taken.insert(joint.name);
    std::set<std::string> seen;
    for (int j = 0; j < clip_.motion.rig.num_joints(); ++j) {
      std::string& name = clip_.motion.rig.joints[j].name;
      if (!name.empty() && seen.insert(name).second) continue;
      const std::string base = name.empty() ? "joint" : name;
      name = fmt::format("{}_{}", base, clip_.joints[j].node);
      while (!taken.insert(name).second) name += "_";
    }
  }

  void NoteScales() {
    int uneven = 0, changing = 0;
    for (const GltfJoint& joint : clip_.joints) {
      if (model_.nodes[joint.node].children.empty()) continue;
      uneven += IsUniform(joint.scale) ? 0 : 1;
      changing += joint.changes_scale ? 1 : 0;
    }
    constexpr const char* kBones =
        "bones below change their lengths, and may get keys of "
        "translation in what is written";
    if (uneven > 0) {
      clip_.notes.push_back(fmt::format("nodes that are scaled unevenly: {}; {}", uneven, kBones));
    }
    if (changing > 0) {
      clip_.notes.push_back(fmt::format("nodes that change their scale: {}; {}", changing, kBones));
    }
  }

  const LoadedGltf& gltf_;
  const tinygltf::Model& model_;
  const GltfTracks& tracks_;
  GltfClip& clip_;
  std::set<int> seeds_;
  std::map<int, std::vector<Bind>> bind_;  // by node, in each skin's space
  std::vector<bool> chosen_;               // [nodes]
  std::vector<bool> leads_;                // [nodes] to a seed
  std::vector<Frame> frame_;               // [nodes] of those above the rig
  std::vector<int> joint_of_node_;
};

}  // namespace

void BuildSkeleton(const LoadedGltf& gltf, const std::vector<int>& skins,
                   const std::vector<int>& humanoid, const GltfTracks& tracks,
                   GltfAccessors* accessors, GltfClip* clip) {
  SkeletonBuilder(gltf, skins, tracks, accessors, clip).Build(humanoid);
}

}  // namespace retarget::io
