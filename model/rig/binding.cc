#include "model/rig/binding.h"

#include <algorithm>
#include <cmath>

#include "model/geometry/quantile.h"
#include "model/geometry/so3.h"
#include "model/rig/standard_links.h"

namespace retarget {
namespace {

constexpr int kMostSamples = 300;  // frames looked at for lengths and the reference

Vec3 MedianPoint(const std::vector<Vec3>& points) {
  Vec3 out;
  for (int k = 0; k < 3; ++k) {
    std::vector<double> values;
    for (const Vec3& p : points) values.push_back(p[k]);
    out[k] = Median(values);
  }
  return out;
}

}  // namespace

RigBinding::World RigBinding::ToWorld(const RigFrame& frame) const {
  const PosedRig posed = PoseRig(rig_, frame);
  World world;
  for (size_t j = 0; j < rig_.joints.size(); ++j) {
    world.rotation.push_back(up_ * posed.rotation[j]);
    world.position.push_back(scale_ * (up_ * posed.position[j]));
  }
  return world;
}

Vec3 RigBinding::PointIn(const World& world, const RigPoint& point) const {
  return world.position[point.joint] + scale_ * (world.rotation[point.joint] * point.offset);
}

// Where a link points in a frame (unit, world) and how long it is (m); false where the rig does not
// say.
bool RigBinding::Direction(const World& world, const LinkBinding& link, Vec3* direction,
                           double* length) const {
  if (!link.to.known()) return false;
  const Vec3 along = PointIn(world, link.to) - PointIn(world, link.from);
  *length = along.norm();
  if (*length < 1e-4) return false;
  *direction = along / *length;
  return true;
}

// The figure's horizontal left: from hip to hip, else from another pair of joints.
Vec3 RigBinding::LeftOf(const World& world) const {
  const JointMap::Side &l = map_.left, &r = map_.right;
  for (const auto& [a, b] : {std::pair{l.hip, r.hip}, {l.shoulder, r.shoulder}, {l.knee, r.knee}}) {
    Vec3 left = world.position[a] - world.position[b];
    left.y() = 0;
    if (left.norm() > 0.01) return left.normalized();
  }
  return Vec3::UnitX();
}

// Small for a figure that stands upright with straight legs and arms held to its sides, down or
// out.
double RigBinding::StandingScore(const World& world) const {
  Vec3 d;
  double length, score = 0;
  const auto away = [&](int link, const Vec3& from) {
    return Direction(world, link_[link], &d, &length) ? 1 - d.dot(from) : 1;
  };
  const Vec3 left = LeftOf(world);
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
  const Vec3 left = LeftOf(reference);
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
                            (PointIn(world, link_[arm].from) - PointIn(world, points_.chest)));
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
    side.clavicle = MedianPoint(clavicle[s]);
    side.clavicle_shoulder = known(arm);
    side.shoulder_elbow = known(arm + 1);
    side.elbow_wrist = known(arm + 2);
    side.wrist_hand = known(arm + 3);
    side.hip = MedianPoint(hip[s]);
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
      const Vec3 next = k + 1 < spine_group_.size() ? world.position[spine_group_[k + 1]]
                                                    : PointIn(world, points_.chest);
      length += (next - world.position[spine_group_[k]]).norm();
    }
    reach.push_back(length);
  }
  const Vec3 pivot = MedianPoint(first);
  const double p = pivot.norm(), r = body_.nodes[1].offset.norm();
  if (p < 0.01) return;  // the spine begins at the root: no limit
  const double longest = Median(reach) + kSpineSlack;
  const double cosine = (r * r + p * p - longest * longest) / (2 * r * p);
  JointLimit& limit = body_.links[kWaist].limit;
  const double swing = std::acos(std::clamp(cosine, -1.0, 1.0));
  limit.reach = swing;
  limit.reach_centre = pivot / p;
}

RigBinding::RigBinding(const RigMotion& motion, const RigFacts& facts, int chest_bone,
                       double stature)
    : rig_(motion.rig),
      map_(facts.map),
      chest_bone_(chest_bone),
      scale_(facts.metres_per_unit),
      followers_(facts.followers) {
  if (facts.up == 'z') up_ = Quat(Eigen::AngleAxisd(-kPi / 2, Vec3::UnitX()));
  const std::vector<PosedRig> samples = SamplePoses(motion);
  points_ = FindPoints(rig_, samples, map_, chest_bone_);
  MapLinks();
  FindTwistHelpers(samples.front());
  body_ = StandardBody(AverageMeasures(1.75));  // its tree is all that binding needs
  BindTurns(ReferenceFrame(motion));
  std::vector<World> frames;
  const int step = std::max(1, motion.num_frames() / kMostSamples);
  for (int k = 0; k < motion.num_frames(); k += step) frames.push_back(ToWorld(motion.frames[k]));
  const BodyMeasures measures = Measure(frames);
  body_ = StandardBody(measures);
  EstimateHinges(frames);
  LimitWaist(frames);
  for (int l = 0; l < kNumLinks; ++l) body_.links[l].locked = locked_[l];
  if (stature > 0) {
    ratio_ = stature / body_.stature;
    scale_ *= ratio_;
    body_ = ScaledTo(body_, stature);
  }
  joint_at_node_.assign(body_.nodes.size(), -1);
  joint_at_node_[0] = map_.root;
  for (int n = 1; n < body_.num_nodes(); ++n) {
    const RigPoint& at = body_.nodes[n].link != kRoot        ? link_[body_.nodes[n].link].to
                         : body_.nodes[n].name == "left_hip" ? points_.left.hip
                                                             : points_.right.hip;
    if (at.is_joint()) joint_at_node_[n] = at.joint;
  }
  FindFreedom();
}

}  // namespace retarget
