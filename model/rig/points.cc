#include "model/rig/points.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "model/body/body.h"
#include "model/geometry/quantile.h"

namespace retarget {
namespace {

constexpr int kSamples = 48;
// Shares of the stature.
constexpr double kNeckHead = 0.050, kShoulderNeck = 0.015;
constexpr double kShortestHead = 0.08, kTallestHead = 0.30;  // from its joint to the vertex
constexpr double kSamePlace = 0.005;  // joints nearer than this stand at one place
constexpr double kApart = 0.04;       // of the neck, and of the root if there is a choice
constexpr double kBarelyApart = 0.02;

Vec3 Direction(const Vec3& v) { return v.norm() > 0 ? Vec3(v.normalized()) : Vec3::Zero(); }

// A place in the frame of `carrier`: the median over the poses of what `place` says of each.
template <typename Place>
RigPoint PlaceOn(const std::vector<PosedRig>& poses, int carrier, const Place& place) {
  std::vector<double> values[3];
  for (const PosedRig& pose : poses) {
    const Vec3 local = pose.rotation[carrier].conjugate() * (place(pose) - pose.position[carrier]);
    for (int k = 0; k < 3; ++k) values[k].push_back(local[k]);
  }
  return {carrier, Vec3(Median(values[0]), Median(values[1]), Median(values[2]))};
}

RigPoint JointPoint(int joint) { return {joint, Vec3::Zero()}; }

// Where a bone ends: its End Site, else a child away from it, else the end of a child at the same
// place (a hand under a wrist).
RigPoint EndOf(const Rig& rig, int bone) {
  const auto end_site = [&](int j) { return rig.joints[j].end_site.value_or(Vec3::Zero()); };
  if (end_site(bone).norm() > 0) return {bone, end_site(bone)};
  for (const int child : rig.ChildrenOf(bone)) {
    if (rig.joints[child].offset.norm() > 0) return JointPoint(child);
    if (end_site(child).norm() > 0) return {child, end_site(child)};
  }
  return {};
}

class PointFinder {
 public:
  PointFinder(const Rig& rig, const std::vector<PosedRig>& poses, const JointMap& map)
      : rig_(rig), poses_(poses), map_(map), stature_(ReferenceStature(poses, map)) {}

  RigPoints Find(int chest_bone) {
    RigPoints p;
    p.root = JointPoint(map_.root);
    p.neck = Neck();
    FindHead(&p);
    p.chest = Chest(chest_bone, p.neck);
    FindSide(map_.left, p.neck, &p.left);
    FindSide(map_.right, p.neck, &p.right);
    return p;
  }

  int ChestBone() {
    const RigPoint neck = Neck(), root = JointPoint(map_.root);
    for (const double from_root : {kApart, kBarelyApart}) {
      for (size_t n = map_.spine.size(); n-- > 0;) {
        const RigPoint bone = JointPoint(map_.spine[n]);
        if (MedianDistance(poses_, bone, neck) >= kApart * stature_ &&
            MedianDistance(poses_, bone, root) >= from_root * stature_) {
          return bone.joint;
        }
      }
    }
    return -1;
  }

  int Carrier() {
    const RigPoint neck = Neck();
    for (size_t n = map_.spine.size(); n-- > 0;) {
      if (MedianDistance(poses_, JointPoint(map_.spine[n]), neck) >= kApart * stature_) {
        return map_.spine[n];
      }
    }
    return map_.root;
  }

 private:
  // The bone below the neck.
  int TopOfTrunk() const { return map_.spine.empty() ? map_.root : map_.spine.back(); }

  bool SamePlace(int a, int b) const {
    return MedianDistance(poses_, JointPoint(a), JointPoint(b)) < kSamePlace * stature_;
  }

  RigPoint Neck() const {
    const int carrier = TopOfTrunk();
    if (!map_.neck.empty() && (map_.head < 0 || !SamePlace(map_.neck.front(), map_.head))) {
      return JointPoint(map_.neck.front());
    }
    if (map_.head >= 0 && !SamePlace(map_.head, carrier)) {  // below the head
      return PlaceOn(poses_, carrier, [&](const PosedRig& pose) -> Vec3 {
        const Vec3& head = pose.position[map_.head];
        const Vec3 down = pose.position[carrier] - head;
        return head + std::min(kNeckHead * stature_, 0.3 * down.norm()) * Direction(down);
      });
    }
    return PlaceOn(poses_, carrier, [&](const PosedRig& pose) -> Vec3 {  // between the shoulders
      const Vec3 middle =
          (pose.position[map_.left.shoulder] + pose.position[map_.right.shoulder]) / 2;
      return middle + kShoulderNeck * stature_ * Direction(middle - pose.position[map_.root]);
    });
  }

  bool IsShort(const RigPoints& p) const {
    return MedianDistance(poses_, p.head, p.head_top) < kShortestHead * stature_;
  }

  void FindHead(RigPoints* p) const {
    if (map_.head >= 0) {
      p->head = JointPoint(map_.head);
      const RigJoint& head = rig_.joints[map_.head];
      if (map_.head_top >= 0) {
        p->head_top = JointPoint(map_.head_top);
      } else if (head.end_site.value_or(Vec3::Zero()).norm() > 0) {
        p->head_top = {map_.head, *head.end_site};
      }
      // The tail of a leaf bone ends anywhere in the head; the skin does not.
      if (head.skin_top && (!p->head_top.known() || IsShort(*p))) {
        const RigPoint top = {map_.head, *head.skin_top};
        if (MedianDistance(poses_, p->head, top) < kTallestHead * stature_) p->head_top = top;
      }
      return;
    }
    const int carrier = map_.neck.empty() ? TopOfTrunk() : map_.neck.back();
    const RigPoint end = map_.neck.empty() ? RigPoint{} : EndOf(rig_, carrier);
    constexpr double kHeadShare = kNeckHead / (kNeckHead + 0.120);  // of neck to vertex
    constexpr double kLongestNeck = 0.09;
    if (!end.known()) {
      p->head = PlaceOn(poses_, carrier, [&](const PosedRig& pose) -> Vec3 {
        const Vec3 neck = At(pose, p->neck);
        return neck + kNeckHead * stature_ * Direction(neck - pose.position[map_.root]);
      });
    } else if (MedianDistance(poses_, p->neck, end) < kLongestNeck * stature_) {
      p->head = end;
    } else {
      p->head_top = end;
      p->head = PlaceOn(poses_, carrier, [&](const PosedRig& pose) -> Vec3 {
        return At(pose, p->neck) + kHeadShare * (At(pose, end) - At(pose, p->neck));
      });
    }
  }

  RigPoint Chest(int chest_bone, const RigPoint& neck) {
    if (chest_bone >= 0) return JointPoint(chest_bone);
    constexpr double kChestShare = 0.125 / (0.125 + 0.145);  // of root to neck
    const int carrier = Carrier();
    return PlaceOn(poses_, carrier, [&](const PosedRig& pose) -> Vec3 {
      const Vec3& from = pose.position[carrier];
      return from + kChestShare * (At(pose, neck) - from);
    });
  }

  void FindSide(const JointMap::Side& map, const RigPoint& neck, RigPoints::Side* p) const {
    constexpr double kForearm = 0.146 / 0.186, kShin = 0.246 / 0.245;
    p->clavicle = map.clavicle >= 0 ? JointPoint(map.clavicle) : neck;
    p->shoulder = JointPoint(map.shoulder);
    p->elbow = JointPoint(map.elbow);
    p->wrist = LimbEnd(map.wrist, map.shoulder, map.elbow, kForearm);
    p->hip = JointPoint(map.hip);
    p->knee = JointPoint(map.knee);
    p->ankle = LimbEnd(map.ankle, map.hip, map.knee, kShin);
    if (map.hand >= 0) p->hand = JointPoint(map.hand);
    if (map.hand < 0 && map.wrist >= 0) p->hand = EndOf(rig_, map.wrist);
    if (map.toe >= 0) p->toe = JointPoint(map.toe);
    if (map.toe < 0 && map.ankle >= 0) p->toe = EndOf(rig_, map.ankle);
  }

  // Wrist or ankle: the joint, else the end of the bone above if it is about as long as it should
  // be, else in line with the bone above as the rest pose has it.
  RigPoint LimbEnd(int joint, int upper, int lower, double share) const {
    if (joint >= 0) return JointPoint(joint);
    const double length = share * MedianDistance(poses_, JointPoint(upper), JointPoint(lower));
    const RigPoint end = EndOf(rig_, lower);
    if (end.known()) {
      const double is = MedianDistance(poses_, JointPoint(lower), end);
      if (is > 0.6 * length && is < 1.6 * length) return end;
    }
    return {lower, length * Direction(rig_.joints[lower].offset)};
  }

  const Rig& rig_;
  const std::vector<PosedRig>& poses_;
  const JointMap& map_;
  double stature_;
};

}  // namespace

std::vector<PosedRig> SamplePoses(const RigMotion& motion) {
  const int count = std::min(kSamples, motion.num_frames());
  std::vector<PosedRig> poses;
  for (int s = 0; s < count; ++s) {
    const int frame =
        count == 1 ? 0 : static_cast<int>(int64_t{s} * (motion.num_frames() - 1) / (count - 1));
    poses.push_back(PoseRig(motion.rig, motion.frames[frame]));
  }
  return poses;
}

double MedianDistance(const std::vector<PosedRig>& poses, const RigPoint& a, const RigPoint& b) {
  std::vector<double> lengths;
  for (const PosedRig& pose : poses) lengths.push_back((At(pose, a) - At(pose, b)).norm());
  return Median(std::move(lengths));
}

double ReferenceStature(const std::vector<PosedRig>& poses, const JointMap& map) {
  const BodyMeasures average = AverageMeasures(1);
  double sum = 0;
  int count = 0;
  const auto add = [&](int from, int to, double share) {
    if (to < 0) return;
    sum += MedianDistance(poses, JointPoint(from), JointPoint(to)) / share;
    ++count;
  };
  for (const JointMap::Side* side : {&map.left, &map.right}) {
    add(side->shoulder, side->elbow, average.left.shoulder_elbow);
    add(side->elbow, side->wrist, average.left.elbow_wrist);
    add(side->hip, side->knee, average.left.hip_knee);
    add(side->knee, side->ankle, average.left.knee_ankle);
  }
  return sum / count;
}

RigPoints FindPoints(const Rig& rig, const std::vector<PosedRig>& poses, const JointMap& map,
                     int chest_bone) {
  return PointFinder(rig, poses, map).Find(chest_bone);
}

int FindChestBone(const Rig& rig, const std::vector<PosedRig>& poses, const JointMap& map) {
  return PointFinder(rig, poses, map).ChestBone();
}

int ChestCarrier(const Rig& rig, const std::vector<PosedRig>& poses, const JointMap& map) {
  return PointFinder(rig, poses, map).Carrier();
}

}  // namespace retarget
