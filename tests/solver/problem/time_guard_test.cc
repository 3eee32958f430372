// Motions that go through from one frame to the next: seen, refused by the solve, and cured.
#include "solver/problem/time_guard.h"

#include <gtest/gtest.h>

#include "solver/optimizer/spacetime.h"
#include "solver/start/quasi_static.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

constexpr int kFrames = 20;
constexpr int kFirst = 8, kLast = 12;  // frames that are elsewhere

// a's arms round b's chest, nobody moves.
Scene Still() {
  Scene scene = SmallScene(kFrames, 0);
  scene.holds.clear();
  for (auto& contacts : scene.contacts) contacts.clear();
  return scene;
}

// The same with a so far beside b in some frames that b is outside its arms: on the way there one
// goes through b.
Unknowns SteppingAside(const Scene& scene, double by) {
  Unknowns x = UnknownsFromPoses(scene, scene.source);
  for (int t = kFirst; t <= kLast; ++t) x.edit(0, t) += by;
  return x;
}

std::vector<NodePositions> NodesOf(const Scene& scene, const Unknowns& x) {
  std::vector<NodePositions> nodes;
  Frame frame;
  for (int t = 0; t < scene.num_frames(); ++t) {
    frame.Set(scene, x, t, false);
    nodes.push_back({frame.posed[0].node, frame.posed[1].node});
  }
  return nodes;
}

std::vector<int> ThroughIn(const Scene& scene, const Unknowns& x) {
  std::vector<int> frames;
  const std::vector<char> through = FramesThatGoThrough(scene, x.edit, NodesOf(scene, x), false, 2);
  EXPECT_EQ(through.size(), static_cast<size_t>(kFrames - 1));
  for (int t = 0; t + 1 < kFrames; ++t) {
    if (through[t]) frames.push_back(t);
    EXPECT_EQ(through[t] != 0, WayBetween(scene, x.edit, t, t + 1).jump.size > 0.5) << t;
  }
  return frames;
}

TEST(TimeGuard, ArmsThatLeaveAndComeBackThroughTheBodyAreSeen) {
  const Scene scene = Still();
  EXPECT_EQ(ThroughIn(scene, UnknownsFromPoses(scene, scene.source)), std::vector<int>());
  EXPECT_EQ(ThroughIn(scene, SteppingAside(scene, 0.6)), std::vector<int>({kFirst - 1, kLast}));
  Unknowns nodding = UnknownsFromPoses(scene, scene.source);
  const int head = scene.FirstCoordinate(1) + 3 + 3 * scene.body[1].FindLink("head");
  for (int t = kFirst; t <= kLast; ++t) nodding.edit(head, t) = 0.3;
  EXPECT_EQ(ThroughIn(scene, nodding), std::vector<int>());
}

TEST(TimeGuard, BothFiguresCarriedAlongFastAreNot) {
  Scene scene = Still();
  for (Clip& clip : scene.source) {
    for (int t = 0; t < kFrames; ++t) {
      clip.frames[t] = Moved(clip.frames[t], YawRotation(0.5 * t), Vec3(0.4 * t, 0, 0));
    }
  }
  EXPECT_EQ(ThroughIn(scene, UnknownsFromPoses(scene, scene.source)), std::vector<int>());
}

TEST(TimeGuard, WhatGoesThroughIsCuredFromTheTemplatesSide) {
  for (const int middle : {0, kFrames - 1}) {
    Scene scene = Still();
    scene.template_frame = middle;
    const Problem problem(scene, {});
    Unknowns x = SteppingAside(scene, 0.6);
    EXPECT_EQ(CurePassThroughs(problem, &x), kLast - kFirst + 1);
    EXPECT_EQ(ThroughIn(scene, x), std::vector<int>());
    for (int t = kFirst; t <= kLast; ++t) EXPECT_LT(std::abs(x.edit(0, t)), 0.2) << t;
    Unknowns sound = UnknownsFromPoses(scene, scene.source);
    const MatX before = sound.edit;
    EXPECT_EQ(CurePassThroughs(problem, &sound), 0);
    EXPECT_EQ(sound.edit, before);
  }
}

// Pulls b's root by y and z (m) in some frames.
class Pull : public Term {
 public:
  Pull(const Scene& scene, double y, double z) : first_(scene.FirstCoordinate(1)), y_(y), z_(z) {}
  const char* name() const override { return "pull"; }
  const char* unit() const override { return "m"; }
  int row_slots(const Frame&) const override { return 2; }
  void EvaluatePart(const Frame& frame, int, Rows* rows) const override {
    if (frame.t < kFirst || frame.t > kLast) return;
    const Vec3& root = frame.posed[1].centre[0];
    rows->AddPoint(rows->Add(frame.x[first_ + 1] - y_), 1, 0, root, Vec3::UnitY());
    rows->AddPoint(rows->Add(frame.x[first_ + 2] - z_), 1, 0, root, Vec3::UnitZ());
  }

 private:
  int first_;
  double y_, z_;
};

// b's forearm lies across a's, 5 cm above it, both in the air.
Scene Crossed() {
  Scene scene;
  for (int f = 0; f < 2; ++f) {
    scene.body[f] = StandardBody(AverageMeasures(1.8 - 0.1 * f));
    scene.posture.pose[f] = RestPose(scene.body[f]);
    scene.posture.pose[f].root_position.y() = 3;
  }
  Pose& b = scene.posture.pose[1];
  b.rotation[0] = Turn(0, 90, 0);
  const auto middle = [&](int f) -> Vec3 {
    const PosedBody posed = PoseBody(scene.body[f], scene.posture.pose[f]);
    return 0.5 * (posed.node[scene.body[f].FindNode("left_elbow")] +
                  posed.node[scene.body[f].FindNode("left_wrist")]);
  };
  b.root_position += middle(0) + Vec3(0, 0.05, 0) - middle(1);
  for (int f = 0; f < 2; ++f) {
    scene.source[f].fps = 30;
    scene.source[f].frames.assign(kFrames, scene.posture.pose[f]);
  }
  return scene;
}

// b's hand slips off a's forearm, goes below it and comes back. No step leads through anything; but
// in the frame before b is still above, so from there to the first of these the way would.
TEST(TimeGuard, NoStepOfTheSolveLeadsThroughInTime) {
  const Scene scene = Crossed();
  const int y = scene.FirstCoordinate(1) + 1, z = y + 1;
  for (const Backend backend : {Backend::kBanded, Backend::kCeres}) {
    Settings settings;
    settings.solve.backend = backend;
    settings.solve.stages = {0.5, 1};  // else dips are refused, too
    settings.weights.penetration = 0;
    settings.weights.smoothness = settings.weights.root_smoothness = 0.01;
    settings.weights.root_tracking = 0.1;
    const auto pulled = [&](const Unknowns& from, double up, double aside) {
      Problem problem(scene, settings);
      problem.Add(std::make_unique<Pull>(scene, up, aside), 10);
      return SolveSpacetime(problem, from, nullptr).unknowns;
    };
    const Unknowns off = pulled(UnknownsFromPoses(scene, scene.source), 0, 0.9);
    EXPECT_NEAR(off.edit(z, kFirst), 0.9, 0.05);
    const Unknowns below = pulled(off, -0.1, 0.9);
    EXPECT_NEAR(below.edit(y, kFirst), -0.1, 0.01);
    EXPECT_EQ(ThroughIn(scene, below), std::vector<int>());
    Unknowns wanted = below;
    for (int t = kFirst; t <= kLast; ++t) wanted.edit(z, t) = 0;
    EXPECT_EQ(ThroughIn(scene, wanted), std::vector<int>({kFirst - 1, kLast}));
    const Unknowns back = pulled(below, -0.1, 0);
    EXPECT_EQ(ThroughIn(scene, back), std::vector<int>()) << NameOf(backend);
    EXPECT_LT(back.edit(z, kFirst), 0.85) << "as far as it could";
  }
}

}  // namespace
}  // namespace retarget::solver
