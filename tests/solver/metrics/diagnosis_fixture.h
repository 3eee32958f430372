// Scenes whose diagnoses are known beforehand.
#pragma once

#include <gtest/gtest.h>

#include "solver/metrics/diagnosis.h"
#include "solver/optimizer/spacetime.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {

// A scene that is solved and measured.
struct Solved {
  Scene scene;
  Settings settings;
  std::unique_ptr<Problem> problem;
  Unknowns unknowns;
  MetricsContext subject;
  Metrics metrics;
  std::vector<RequirementCheck> checks;
  std::vector<Diagnosis> diagnoses;

  Solved(const Scene& s, const Settings& with) : scene(s), settings(with) {
    problem = std::make_unique<Problem>(scene, settings);
    unknowns = SolveSpacetime(*problem, UnknownsFromPoses(scene, scene.source), {}).unknowns;
    subject = MetricsContextOf(scene);
    const std::array<Clip, 2> solved = EditedClips(scene, unknowns);
    metrics = Measure(subject, ViewOf(scene.body, solved), ViewOf(scene.body, scene.source));
    checks = CheckRequirements(subject, metrics, settings.requirements);
    diagnoses = Diagnose(*problem, unknowns, subject, metrics, checks);
  }
  // About a hold, from 0.
  const Diagnosis& OfHold(int k) const {
    for (const Diagnosis& c : diagnoses) {
      if (c.check.kind == RequirementKind::kHold && c.check.item == k) return c;
    }
    throw std::runtime_error("no diagnosis about hold " + std::to_string(k));
  }
  size_t IndexOf(const std::string& term) const {
    const std::vector<TermCost> costs = problem->CostByTerm(unknowns);
    for (size_t k = 0; k < costs.size(); ++k) {
      if (costs[k].name == term) return k;
    }
    throw std::runtime_error("no term " + term);
  }
};

// A still scene in which a's left hand is to be at points of the world, `away` from where it is.
// b stands apart, and both so high that no foot reaches into the floor.
inline Scene HandTo(const std::vector<Vec3>& away) {
  Scene scene = SmallScene(9, 0);
  for (Pose& pose : scene.source[0].frames) pose.root_position.y() += 0.1;
  for (Pose& pose : scene.source[1].frames) pose.root_position += Vec3(0, 0.1, 8);
  const PosedBody posed = PoseBody(scene.body[0], scene.source[0].frames[0]);
  scene.holds.clear();
  scene.tangles.clear();
  for (const Vec3& d : away) {
    Hold hold;
    hold.from = {0, scene.body[0].FindNode("left_hand"), Vec3::Zero()};
    hold.to = {kWorld, 0, posed.node[hold.from.node] + d};
    scene.holds.push_back(hold);
  }
  return scene;
}

// Checks that say what is missed without a solve.
class MissTest : public testing::Test {
 protected:
  MissTest() : scene_(SmallScene(9, 0)) {
    subject_ = MetricsContextOf(scene_);
    unknowns_ = UnknownsFromPoses(scene_, scene_.source);
    metrics_ =
        Measure(subject_, ViewOf(scene_.body, scene_.source), ViewOf(scene_.body, scene_.source));
  }
  Diagnosis ConflictAbout(const RequirementCheck& check, const Settings& settings = {}) const {
    const Problem problem(scene_, settings);
    return Diagnose(problem, unknowns_, subject_, metrics_, {check}).at(0);
  }
  int Node(int f, const char* name) const { return scene_.body[f].FindNode(name); }

  // The right toes of both are planted in frame 5; b's is laid onto a's.
  RequirementCheck FeetInOnePlace() {
    const std::array<PosedBody, 2> posed = {PoseBody(scene_.body[0], scene_.source[0].frames[5]),
                                            PoseBody(scene_.body[1], scene_.source[1].frames[5])};
    const Vec3 d = posed[0].node[Node(0, "right_toe")] - posed[1].node[Node(1, "right_toe")];
    for (Pose& pose : scene_.source[1].frames) pose.root_position += d;
    unknowns_ = UnknownsFromPoses(scene_, scene_.source);
    return {.kind = RequirementKind::kPenetration,
            .value = 0.06,
            .limit = 0.02,
            .met = false,
            .frame = 5,
            .limbs = {{0, Node(0, "right_toe")}, {1, Node(1, "right_toe")}}};
  }

  // Two limbs that pass.
  RequirementCheck PassThroughs() {
    metrics_.pass_throughs = {{3, Node(0, "left_wrist"), Node(1, "head")}, {4, 1, 1}};
    return {.kind = RequirementKind::kPassThroughs,
            .value = 2,
            .met = false,
            .frame = 3,
            .limbs = {{0, Node(0, "left_wrist")}, {1, Node(1, "head")}}};
  }

  // The first tag is lost; b has walked 20 m away: no move of a limb changes the GLI by much.
  RequirementCheck TagFarAway() {
    const Tangle& t = scene_.tangles.at(0).tag.tangle;
    for (Pose& pose : scene_.source[1].frames) pose.root_position.z() += 20;
    unknowns_ = UnknownsFromPoses(scene_, scene_.source);
    return {.kind = RequirementKind::kTangle,
            .item = 0,
            .value = 0.02,
            .limit = 0.5,
            .met = false,
            .frame = 4,
            .limbs = {{0, t.a.from}, {0, t.a.to}, {1, t.b.from}, {1, t.b.to}}};
  }

  static RequirementCheck WriteBack() {
    return {.kind = RequirementKind::kWriteBack,
            .figure = 0,
            .value = 0.007,
            .limit = 0.005,
            .met = false};
  }

  Scene scene_;
  MetricsContext subject_;
  Unknowns unknowns_;
  Metrics metrics_;
};

// Stiff poses keep a hand away from its place; all weights are usual ones.
inline Settings StiffSettings() {
  Settings settings;
  settings.weights.pose_tracking = 2;
  settings.weights.root_tracking = 12;
  settings.weights.hold = 30;
  settings.weights.foot_lock = 300;
  settings.requirements.hold_m = 1e-3;
  return settings;
}

// Nearly free but for planted feet.
inline Settings PlantedSettings() {
  Settings settings;
  settings.weights.root_tracking = 0.1;
  settings.weights.pose_tracking = 0.1;
  settings.weights.joint_limit = 0.1;
  settings.weights.penetration = settings.weights.self_penetration = 0;
  settings.weights.foot_lock = 1000;
  return settings;
}

}  // namespace retarget::solver
