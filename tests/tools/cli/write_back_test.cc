// The way to the body and back, on real files: what is not edited comes back as it was.
#include "model/rig/write_back.h"

#include "io/bvh/bvh.h"
#include "io/recognition/recognise.h"
#include "model/geometry/so3.h"
#include "tests/test_data.h"

namespace retarget::cli {
namespace {

std::vector<std::string> RealClips() {
  std::vector<std::string> clips;
  for (const char* folder : {"data/clips", "data/pairs"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(SharedPath(folder))) {
      if (entry.path().extension() == ".bvh") clips.push_back(entry.path().string());
    }
  }
  for (const char* name :
       {"mixed_rotation_orders", "standard_skeleton_1frame", "lafan_zero_frame0"}) {
    clips.push_back(SharedPath(std::string("data/odd_bvh/") + name + ".bvh"));
  }
  std::sort(clips.begin(), clips.end());
  return clips;
}

struct Bound {
  io::BvhFile file;
  RigFacts facts;
  std::unique_ptr<RigBinding> binding;
};

Bound Bind(const std::string& path, int most_frames, double stature = 0) {
  Bound bound;
  bound.file = io::ReadBvh(path);
  auto& frames = bound.file.motion.frames;
  // Past the calibration poses at the start, which the salsa files blend out of over six frames.
  if (frames.size() > 8) frames.erase(frames.begin(), frames.begin() + 7);
  if (frames.size() > static_cast<size_t>(most_frames))
    frames.resize(static_cast<size_t>(most_frames));
  io::RecogniseOptions options;
  if (path.find("pairs") != std::string::npos) options.metres_per_unit = 1.35;
  bound.facts = io::Recognise(bound.file.motion, options, path);
  bound.binding = std::make_unique<RigBinding>(
      bound.file.motion, bound.facts, io::ChestBone(bound.file.motion, bound.facts.map), stature);
  return bound;
}

TEST(WriteBack, IdentityReturnsEveryRealClip) {
  SKIP_WITHOUT_SHARED_DATA();
  int checked = 0;
  for (const std::string& path : RealClips()) {
    const Bound bound = Bind(path, 120);
    const RigMotion& captured = bound.file.motion;
    Clip clip;
    clip.fps = 30;
    const int frames = static_cast<int>((captured.num_frames() - 1) * captured.frame_time * 30) + 1;
    for (int k = 0; k < frames; ++k) {
      clip.frames.push_back(bound.binding->PoseOf(SampleRig(captured, k / clip.fps)));
    }
    const RigMotion back = WriteBack(
        captured, *bound.binding, 0, [](const Pose& p) { return p; }, clip, clip);
    const RigMotion read = io::ParseBvh(io::FormatBvh(bound.file, back), "back").motion;
    ASSERT_GE(read.num_frames(), 1) << path;
    for (int k = 0; k < read.num_frames(); ++k) {
      const PosedRig before = PoseRig(captured.rig, captured.frames[k]);
      const PosedRig after = PoseRig(read.rig, read.frames[k]);
      for (size_t j = 0; j < before.position.size(); ++j) {
        ASSERT_LT(bound.facts.metres_per_unit * (before.position[j] - after.position[j]).norm(),
                  1e-4)
            << path << " frame " << k << " " << captured.rig.joints[j].name;
        ASSERT_LT(before.rotation[j].angularDistance(after.rotation[j]), 0.01 * kDegree)
            << path << " frame " << k << " " << captured.rig.joints[j].name;
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 20000);
}

// The body's nodes are where the rig's joints are: exactly where one bone carries them, and within
// a centimetre where a flexible spine stands between (root-relative).
TEST(RigBinding, NodesStandAtTheJointsOfEveryRealClip) {
  SKIP_WITHOUT_SHARED_DATA();
  int checked = 0;
  for (const std::string& path : RealClips()) {
    if (path.find("salsa_10/60") != std::string::npos)
      continue;  // its limbs change length (README)
    const Bound bound = Bind(path, 300);
    const Body& body = bound.binding->body();
    for (int k = 0; k < bound.file.motion.num_frames(); k += 7) {
      const PosedBody posed = PoseBody(body, bound.binding->PoseOf(bound.file.motion.frames[k]));
      const std::vector<Vec3> joints = bound.binding->JointPositions(bound.file.motion.frames[k]);
      for (int n = 0; n < body.num_nodes(); ++n) {
        const int joint = bound.binding->JointAtNode(n);
        if (joint < 0) continue;
        ASSERT_LT((joints[joint] - posed.node[n]).norm(), 0.01)
            << path << " frame " << k << " " << body.nodes[n].name;
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 5000);
}

// Equal link rotations are equal postures on any rig: a pose put onto another rig points the limbs
// the same way.
TEST(RigBinding, AppliedPosesComeBack) {
  const Bound bound = Bind(ProjectPath("data/holds/bear_hug/a.bvh"), 50);
  const RigFrame& frame = bound.file.motion.frames[20];
  Pose pose = bound.binding->PoseOf(frame);
  const Body& body = bound.binding->body();
  pose.root_position += Vec3(0.3, -0.02, 0.1);
  pose.rotation[0] = YawRotation(0.4) * pose.rotation[0];
  for (const char* name : {"chest", "head", "left_shoulder", "left_elbow", "right_hip",
                           "right_knee", "left_ankle", "right_wrist"}) {
    Quat& q = pose.rotation[body.FindLink(name)];
    q = q * ExpSo3(Vec3(0.1, -0.05, 0.08));
  }
  const Pose back = bound.binding->PoseOf(bound.binding->Apply(frame, pose));
  const PosedBody expected = PoseBody(body, pose), got = PoseBody(body, back);
  for (int n = 0; n < body.num_nodes(); ++n) {
    EXPECT_LT((expected.node[n] - got.node[n]).norm(), 0.004) << body.nodes[n].name;
  }
}

TEST(RigBinding, AnotherStatureScalesEverything) {
  const std::string path = ProjectPath("data/holds/bear_hug/a.bvh");
  const Bound own = Bind(path, 30), small = Bind(path, 30, 1.5);
  EXPECT_NEAR(small.binding->body().stature, 1.5, 1e-9);
  const double ratio = 1.5 / own.binding->body().stature;
  const Pose p = own.binding->PoseOf(own.file.motion.frames[9]);
  const Pose q = small.binding->PoseOf(small.file.motion.frames[9]);
  EXPECT_LT((ratio * p.root_position - q.root_position).norm(), 1e-9);
  for (size_t l = 0; l < p.rotation.size(); ++l) {
    EXPECT_LT(p.rotation[l].angularDistance(q.rotation[l]), 1e-7);
  }
}

}  // namespace
}  // namespace retarget::cli
