#include "model/rig_binding.h"

#include <algorithm>
#include <cmath>

#include "model/so3.h"
#include "model/standard_links.h"

namespace retarget {
namespace {

constexpr int kMostSamples = 300;  // frames looked at for lengths and the reference

double Median(std::vector<double> values) {
  const size_t k = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + static_cast<long>(k), values.end());
  return values[k];
}

Vec3 Median(const std::vector<Vec3>& points) {
  Vec3 out;
  for (int k = 0; k < 3; ++k) {
    std::vector<double> values;
    for (const Vec3& p : points) values.push_back(p[k]);
    out[k] = Median(values);
  }
  return out;
}

int CommonAncestor(const Rig& rig, int i, int j) {
  while (i != j) {
    int& later = i > j ? i : j;
    later = rig.joints[later].parent;
    if (later < 0) return -1;
  }
  return i;
}

void Require(int joint, const char* part) {
  if (joint < 0) throw InputError(std::string("the rig has no ") + part);
}

}  // namespace

RigBinding::LinkBinding RigBinding::Limb(const Rig& rig, int bone, int to,
                                         const Vec3& direction) const {
  LinkBinding link;
  link.bone = link.from = bone;
  link.to = to;
  link.direction = direction;
  if (to >= 0) return link;
  const RigJoint& joint = rig.joints[bone];
  if (joint.end_site) link.end = *joint.end_site;
  if (link.end.norm() > 0) return link;
  for (const int child : rig.ChildrenOf(bone)) {
    if (rig.joints[child].offset.norm() > 0) {
      link.to = child;
      break;
    }
    // A child at the same place (a hand under a wrist): its own children or end point serve.
    if (rig.joints[child].end_site && rig.joints[child].end_site->norm() > 0) {
      link.end = *rig.joints[child].end_site;
      break;
    }
  }
  return link;
}

void RigBinding::MapLinks(const Rig& rig, const JointMap& map, int chest_bone) {
  Require(map.root, "root");
  Require(map.head, "head");
  Require(chest_bone, "spine");
  if (map.neck.empty()) throw InputError("the rig has no neck");
  link_.resize(kNumLinks);
  const int pelvis = CommonAncestor(rig, map.left.hip, map.right.hip);
  const bool pelvis_below_root = pelvis > map.root;
  link_[kRoot].bone = pelvis_below_root ? pelvis : map.root;
  link_[kRoot].from = map.root;

  for (const int bone : map.spine) {
    if (bone == chest_bone) break;
    spine_group_.push_back(bone);
  }
  LinkBinding& waist = link_[kWaist];
  waist.bone = spine_group_.empty() ? map.root : spine_group_[spine_group_.size() / 2];
  waist.from = map.root;
  waist.to = chest_bone;
  LinkBinding& chest = link_[kChest];
  chest.bone = chest.from = chest_bone;
  chest.to = map.neck.front();
  LinkBinding& neck = link_[kNeck];
  neck.bone = neck.from = map.neck.front();
  neck.to = map.head;
  LinkBinding& head = link_[kHead];
  head.bone = head.from = map.head;
  head.to = map.head_top;
  if (head.to < 0 && rig.joints[map.head].end_site) head.end = *rig.joints[map.head].end_site;

  for (const double x : {1.0, -1.0}) {
    const JointMap::Side& side = x > 0 ? map.left : map.right;
    for (const auto& [joint, part] : {std::pair{side.shoulder, "shoulder"},
                                      {side.elbow, "elbow"},
                                      {side.wrist, "wrist"},
                                      {side.hip, "hip"},
                                      {side.knee, "knee"},
                                      {side.ankle, "ankle"}}) {
      Require(joint, part);
    }
    const int arm = x > 0 ? kLeftClavicle : kRightClavicle;
    const Vec3 out(x, 0, 0), down(0, -1, 0);
    LinkBinding& clavicle = link_[arm];
    clavicle.bone = side.clavicle >= 0 ? side.clavicle : chest_bone;
    clavicle.from = side.clavicle >= 0 ? side.clavicle : map.neck.front();
    clavicle.to = side.shoulder;
    clavicle.direction = out;
    link_[arm + 1] = Limb(rig, side.shoulder, side.elbow, out);
    link_[arm + 2] = Limb(rig, side.elbow, side.wrist, out);
    link_[arm + 3] = Limb(rig, side.wrist, side.hand, out);
    const int leg = x > 0 ? kLeftHip : kRightHip;
    link_[leg] = Limb(rig, side.hip, side.knee, down);
    link_[leg + 1] = Limb(rig, side.knee, side.ankle, down);
    link_[leg + 2] = Limb(rig, side.ankle, side.toe, Vec3(0, 0, 1));
  }

  link_of_bone_.assign(rig.joints.size(), -1);
  link_of_bone_[map.root] = kRoot;
  for (const int bone : spine_group_) link_of_bone_[bone] = kWaist;
  bool past_chest = false;
  for (const int bone : map.spine) {
    past_chest = past_chest || bone == chest_bone;
    if (past_chest) link_of_bone_[bone] = kChest;
  }
  for (const int bone : map.neck) link_of_bone_[bone] = kNeck;
  for (int l = kHead; l < kNumLinks; ++l) {
    const bool virtual_clavicle = link_[l].bone == chest_bone;
    if (!virtual_clavicle) link_of_bone_[link_[l].bone] = l;
  }
}

RigBinding::World RigBinding::ToWorld(const RigFrame& frame) const {
  const PosedRig posed = PoseRig(rig_, frame);
  World world;
  for (size_t j = 0; j < rig_.joints.size(); ++j) {
    world.rotation.push_back(up_ * posed.rotation[j]);
    world.position.push_back(scale_ * (up_ * posed.position[j]));
  }
  return world;
}

// Where a link points in a frame (unit, world) and how long it is (m); false where the rig does not
// say.
bool RigBinding::Direction(const World& world, const LinkBinding& link, Vec3* direction,
                           double* length) const {
  Vec3 along;
  if (link.to >= 0) {
    along = world.position[link.to] - world.position[link.from];
  } else {
    along = scale_ * (world.rotation[link.bone] * link.end);
  }
  *length = along.norm();
  if (*length < 1e-4) return false;
  *direction = along / *length;
  return true;
}

// Small for a figure that stands upright with straight legs and arms held to its sides, down or
// out.
double RigBinding::StandingScore(const World& world) const {
  Vec3 d;
  double length, score = 0;
  const auto away = [&](int link, const Vec3& from) {
    return Direction(world, link_[link], &d, &length) ? 1 - d.dot(from) : 1;
  };
  const Vec3 left = (world.position[map_.left.hip] - world.position[map_.right.hip]).normalized();
  for (const int l : {kLeftHip, kLeftKnee, kRightHip, kRightKnee})
    score += 3 * away(l, -Vec3::UnitY());
  for (const int l : {kWaist, kChest}) score += 3 * away(l, Vec3::UnitY());
  const Vec3 ahead = left.cross(Vec3::UnitY());
  for (const int side : {1, -1}) {
    const int arm = side > 0 ? kLeftShoulder : kRightShoulder;
    Vec3 upper = Vec3::Zero();
    for (const int l : {arm, arm + 1}) {
      if (!Direction(world, link_[l], &d, &length)) continue;
      score += std::abs(d.dot(ahead)) + std::max(0.0, d.y()) + std::max(0.0, -side * d.dot(left));
      if (l == arm) upper = d;
      if (l == arm + 1) score += 1 - d.dot(upper);
    }
  }
  return score;
}

RigBinding::World RigBinding::ReferenceFrame(const RigMotion& motion) const {
  RigFrame rest = motion.frames.front();
  for (int j = 0; j < rig_.num_joints(); ++j) rest.rotation[j] = rig_.joints[j].rest_rotation;
  World best = ToWorld(rest);
  double best_score = StandingScore(best);
  const int step = std::max(1, motion.num_frames() / kMostSamples);
  for (int k = 0; k < motion.num_frames(); k += step) {
    const World world = ToWorld(motion.frames[k]);
    const double score = StandingScore(world);
    // The rest pose is preferred unless a frame stands clearly better: it has no noise.
    if (score < best_score - (k == 0 ? 0.5 : 0.05)) {
      best_score = score;
      best = world;
    }
  }
  return best;
}

void RigBinding::BindTurns(const World& reference) {
  std::vector<Quat> link_rotation(kNumLinks);
  const Vec3 up = Vec3::UnitY();
  Vec3 left = reference.position[map_.left.hip] - reference.position[map_.right.hip];
  left = (left - left.dot(up) * up).normalized();
  Mat3 root;
  root << left, up, left.cross(up);
  link_rotation[kRoot] = Quat(root);
  for (int l = 0; l < kNumLinks; ++l) {
    if (l > 0) {
      const Quat& parent = link_rotation[body_.links[l].parent];
      Vec3 direction;
      double length;
      link_rotation[l] = parent;
      if (Direction(reference, link_[l], &direction, &length)) {
        link_rotation[l] = RotationBetween(parent * link_[l].direction, direction) * parent;
      }
    }
    link_[l].turn = reference.rotation[link_[l].bone].conjugate() * link_rotation[l];
  }
}

std::vector<Quat> RigBinding::LinkRotations(const World& world) const {
  std::vector<Quat> rotation(kNumLinks);
  for (int l = 0; l < kNumLinks; ++l) {
    rotation[l] = world.rotation[link_[l].bone] * link_[l].turn;
    Vec3 direction;
    double length;
    // Where the link spans several bones, or a bone's child moves, the direction is that of the
    // joints; elsewhere this turn is the identity.
    if (l > 0 && Direction(world, link_[l], &direction, &length)) {
      rotation[l] = RotationBetween(rotation[l] * link_[l].direction, direction) * rotation[l];
    }
    rotation[l].normalize();
  }
  return rotation;
}

BodyMeasures RigBinding::Measure(const std::vector<World>& frames) const {
  std::vector<std::vector<double>> length(kNumLinks);
  std::array<std::vector<Vec3>, 2> hip, clavicle;
  for (const World& world : frames) {
    const std::vector<Quat> rotation = LinkRotations(world);
    Vec3 direction;
    double d;
    for (int l = 1; l < kNumLinks; ++l) {
      if (Direction(world, link_[l], &direction, &d)) length[l].push_back(d);
    }
    for (int s = 0; s < 2; ++s) {
      const JointMap::Side& side = s == 0 ? map_.left : map_.right;
      const int arm = s == 0 ? kLeftClavicle : kRightClavicle;
      hip[s].push_back(rotation[kRoot].conjugate() *
                       (world.position[side.hip] - world.position[map_.root]));
      clavicle[s].push_back(rotation[kChest].conjugate() *
                            (world.position[link_[arm].from] - world.position[link_[kChest].from]));
    }
  }
  const auto known = [&](int l) { return length[l].empty() ? 0.0 : Median(length[l]); };
  BodyMeasures m;
  m.root_chest = known(kWaist);
  m.chest_neck = known(kChest);
  m.neck_head = known(kNeck);
  m.head_top = known(kHead);
  for (int s = 0; s < 2; ++s) {
    BodyMeasures::Side& side = s == 0 ? m.left : m.right;
    const int arm = s == 0 ? kLeftClavicle : kRightClavicle;
    const int leg = s == 0 ? kLeftHip : kRightHip;
    side.clavicle = Median(clavicle[s]);
    side.clavicle_shoulder = known(arm);
    side.shoulder_elbow = known(arm + 1);
    side.elbow_wrist = known(arm + 2);
    side.wrist_hand = known(arm + 3);
    side.hip = Median(hip[s]);
    side.hip_knee = known(leg);
    side.knee_ankle = known(leg + 1);
    side.ankle_toe = known(leg + 2);
  }
  // What the rig does not say comes from the tables, by the stature of what it does say.
  if (m.head_top <= 0) {
    m.head_top = kHeadLength / (1 - kHeadLength) * StatureOf(m);
  }
  const double stature = StatureOf(m);
  for (BodyMeasures::Side* side : {&m.left, &m.right}) {
    if (side->wrist_hand <= 0) side->wrist_hand = kHandLength * stature;
    if (side->ankle_toe <= 0) side->ankle_toe = kFootLength * stature;
  }
  return m;
}

// The axis that elbows and knees really bend about, which a rest pose with straight limbs cannot
// tell: the mean over the clip, weighted by the bend.
void RigBinding::EstimateHinges(const std::vector<World>& frames) {
  for (const int l : {kLeftElbow, kRightElbow, kLeftKnee, kRightKnee}) {
    JointLimit& limit = body_.links[l].limit;
    Vec3 sum = Vec3::Zero();
    double weight = 0;
    for (const World& world : frames) {
      const std::vector<Quat> rotation = LinkRotations(world);
      const Quat local = rotation[body_.links[l].parent].conjugate() * rotation[l];
      const Vec3 axis = limit.axis.cross(local * limit.axis);
      if (axis.norm() < 0.25) continue;  // nearly straight: the direction says little
      sum += axis;
      weight += axis.norm();
    }
    if (weight > 0 && sum.norm() > 0.7 * weight) {
      limit.hinge_axis = (sum - sum.dot(limit.axis) * limit.axis).normalized();
    } else if (weight > 0) {
      limit.hinge_axis.setZero();  // the rig bends it every way: no hinge
    }
  }
}

// A rig's spine begins some way above the root, so it cannot carry the chest as far round the root
// as the waist joint can turn: beyond some angle the chest would be out of its reach. That angle is
// the waist's limit on this rig.
void RigBinding::LimitWaist(const std::vector<World>& frames) {
  if (spine_group_.empty()) return;
  std::vector<Vec3> first;
  std::vector<double> reach;
  for (const World& world : frames) {
    const std::vector<Quat> rotation = LinkRotations(world);
    const Vec3& root = world.position[map_.root];
    first.push_back(rotation[kRoot].conjugate() * (world.position[spine_group_.front()] - root));
    double length = 0;
    for (size_t k = 0; k < spine_group_.size(); ++k) {
      const int next = k + 1 < spine_group_.size() ? spine_group_[k + 1] : link_[kChest].from;
      length += (world.position[next] - world.position[spine_group_[k]]).norm();
    }
    reach.push_back(length);
  }
  const Vec3 pivot = Median(first);
  const double p = pivot.norm(), r = body_.nodes[1].offset.norm();
  if (p < 0.01) return;  // the spine begins at the root: no limit
  const double longest = Median(reach) + kSpineSlack;
  const double cosine = (r * r + p * p - longest * longest) / (2 * r * p);
  JointLimit& limit = body_.links[kWaist].limit;
  const double swing = std::acos(std::clamp(cosine, -1.0, 1.0));
  if (swing >= limit.swing_max) return;
  limit.swing_max = swing;
  limit.swing_centre = pivot / p;
}

RigBinding::RigBinding(const RigMotion& motion, const RigFacts& facts, int chest_bone,
                       double stature)
    : rig_(motion.rig), map_(facts.map), scale_(facts.metres_per_unit) {
  if (facts.up == 'z') up_ = Quat(Eigen::AngleAxisd(-kPi / 2, Vec3::UnitX()));
  MapLinks(rig_, map_, chest_bone);
  body_ = StandardBody(AverageMeasures(1.75));  // its tree is all that binding needs
  BindTurns(ReferenceFrame(motion));
  std::vector<World> frames;
  const int step = std::max(1, motion.num_frames() / kMostSamples);
  for (int k = 0; k < motion.num_frames(); k += step) frames.push_back(ToWorld(motion.frames[k]));
  const BodyMeasures measures = Measure(frames);
  body_ = StandardBody(measures);
  EstimateHinges(frames);
  LimitWaist(frames);
  body_.links[kWaist].locked = spine_group_.empty();
  for (const int arm : {kLeftClavicle, kRightClavicle}) {
    body_.links[arm].locked = link_[arm].bone == chest_bone;
  }
  if (stature > 0) {
    ratio_ = stature / body_.stature;
    scale_ *= ratio_;
    body_ = ScaledTo(body_, stature);
  }
  joint_at_node_.assign(body_.nodes.size(), -1);
  joint_at_node_[0] = map_.root;
  for (int n = 1; n < body_.num_nodes(); ++n) {
    const LinkBinding& link = link_[body_.nodes[n].link];
    joint_at_node_[n] = body_.nodes[n].link == kRoot
                            ? (body_.nodes[n].name == "left_hip" ? map_.left.hip : map_.right.hip)
                            : link.to;
  }
}

}  // namespace retarget
