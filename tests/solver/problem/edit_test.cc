// Edits of roots that turn by more than pi, about the vertical and tilted: they are followed along
// time, and what is made of them does not leap.
#include <gtest/gtest.h>

#include <cmath>

#include "model/geometry/so3.h"
#include "solver/optimizer/spacetime.h"
#include "solver/problem/root_drift.h"
#include "solver/problem/root_targets.h"
#include "solver/start/start.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

constexpr int kFrames = 90;

// The way from 0 to 1 of a turn that begins and ends softly.
double Ease(int t) {
  const double u = static_cast<double>(t) / (kFrames - 1);
  return u * u * (3 - 2 * u);
}

// b stands; a turns about b's place by `degrees`, both tilted by `tilt_deg` about their own x axes.
Scene Turning(double degrees, double tilt_deg, bool follow = false) {
  Scene scene = SmallScene(1, 0, follow);
  scene.holds.clear();
  const Quat tilt = Turn(tilt_deg, 0, 0);
  for (int f = 0; f < 2; ++f) {
    // Tilted as one.
    scene.posture.pose[f] = Moved(scene.posture.pose[f], tilt, Vec3::Zero());
    scene.contacts[f].clear();
    scene.source[f].frames.assign(kFrames, scene.posture.pose[f]);
  }
  for (int t = 0; t < kFrames; ++t) {
    Pose& a = scene.source[0].frames[t];
    Pose& b = scene.source[1].frames[t];
    const Quat turn = YawRotation(degrees * kDegree * Ease(t));
    (follow ? b : a) = Moved(follow ? b : a, turn, Vec3::Zero());
  }
  scene.base = EditBase(scene);
  return scene;
}

double LargestStep(const std::vector<Pose>& poses) {
  double largest = 0;
  for (size_t t = 1; t < poses.size(); ++t) {
    const Quat step = poses[t - 1].rotation[0].conjugate() * poses[t].rotation[0];
    largest = std::max(largest, LogSo3(step).norm());
  }
  return largest;
}

double LargestLeap(const MatX& edit) {
  double largest = 0;
  for (long t = 1; t < edit.cols(); ++t) {
    largest = std::max(largest, (edit.col(t) - edit.col(t - 1)).cwiseAbs().maxCoeff());
  }
  return largest;
}

TEST(Edit, PosesComeBackFromTheirEdits) {
  for (const bool based : {false, true}) {
    Scene scene = Turning(400, 25);
    if (!based) scene.base = {};
    std::array<Clip, 2> poses;
    for (int f = 0; f < 2; ++f) {
      poses[f] = Fidget(scene.body[f], scene.posture.pose[f], kFrames, 30, 3 + f, 0.5);
    }
    const std::array<Clip, 2> back = EditedClips(scene, UnknownsFromPoses(scene, poses));
    for (int f = 0; f < 2; ++f) {
      for (int t = 0; t < kFrames; ++t) {
        const Pose &p = poses[f].frames[t], &q = back[f].frames[t];
        EXPECT_LT((p.root_position - q.root_position).norm(), 1e-12);
        for (size_t l = 0; l < p.rotation.size(); ++l) {
          EXPECT_LT(LogSo3(p.rotation[l].conjugate() * q.rotation[l]).norm(), 1e-12);
        }
      }
    }
  }
}

TEST(Edit, RotationVectorsAreFollowedBeyondPiOutwardsFromTheTemplate) {
  for (const double tilt : {0.0, 20.0}) {
    for (const int middle : {0, 40, kFrames - 1}) {
      Scene scene = Turning(0, tilt);
      scene.base = {};
      scene.template_frame = middle;
      std::array<Clip, 2> poses = scene.source;
      const double from = Ease(middle);
      for (int t = 0; t < kFrames; ++t) {
        const Quat turn = YawRotation(280 * kDegree * (Ease(t) - from));
        poses[1].frames[t] = Moved(poses[1].frames[t], turn, Vec3::Zero());
      }
      const Unknowns x = UnknownsFromPoses(scene, poses);
      const int first = scene.FirstCoordinate(1);
      EXPECT_LT(LargestLeap(x.edit.middleRows(first + 3, 3)), 6 * kDegree) << tilt << " " << middle;
      EXPECT_NEAR(x.edit.col(middle).norm(), 0, 1e-12);
    }
  }
}

// Roots that are brought together stand to each other as in the template, but for what the limbs
// bear (0.25 rad and 10 cm) and what the window smooths away of a quick turn, wherever the
// template's frame lies and whoever travels.
TEST(Edit, FiguresThatTurnAwayAreBroughtTogether) {
  for (const double degrees : {-400.0, -200.0, 150.0, 200.0, 360.0, 420.0}) {
    for (const double travel : {0.0, 0.5}) {
      for (const int middle : {0, kFrames - 1}) {
        Scene scene = Turning(degrees, 15);
        scene.template_frame = middle;
        // Laid into the template at its frame, b ambling to and fro.
        const Quat back = YawRotation(-degrees * kDegree * Ease(middle));
        for (int t = 0; t < kFrames; ++t) {
          scene.source[0].frames[t] = Moved(scene.source[0].frames[t], back, Vec3::Zero());
          scene.source[1].frames[t].root_position.x() += travel * 0.04 * std::sin(6.0 * t / 30);
        }
        const auto shifts = RootDriftCorrection(scene);
        for (int t = 0; t < kFrames; ++t) {
          const Pose a = ShiftedRoot(scene.source[0].frames[t], shifts[0][t]);
          const Pose b = ShiftedRoot(scene.source[1].frames[t], shifts[1][t]);
          const auto& laid = scene.posture.pose;
          const Quat is = a.rotation[0].conjugate() * b.rotation[0];
          const Quat was = laid[0].rotation[0].conjugate() * laid[1].rotation[0];
          EXPECT_LT(LogSo3(was.conjugate() * is).norm(), 0.35) << degrees << " " << t;
          const Vec3 apart = a.rotation[0].conjugate() * (b.root_position - a.root_position);
          const Vec3 wanted =
              laid[0].rotation[0].conjugate() * (laid[1].root_position - laid[0].root_position);
          EXPECT_LT((apart - wanted).norm(), 0.2) << degrees << " " << travel << " " << t;
          if (t == 0) continue;
          for (int f = 0; f < 2; ++f) {
            EXPECT_LT(std::abs(shifts[f][t].yaw - shifts[f][t - 1].yaw), 0.5) << degrees << t;
          }
        }
      }
    }
  }
}

TEST(Edit, TheBaseMakesNoDifferenceToTheCostOfSmallTurns) {
  Scene scene = Turning(40, 10);
  const Settings settings;
  Scene plain = scene;
  plain.base = {};
  const Problem with(scene, settings), without(plain, settings);
  const std::array<Clip, 2> poses = TemplateRelativePoses(scene);
  const double a = with.Cost(UnknownsFromPoses(scene, poses), 1, 1);
  const double b = without.Cost(UnknownsFromPoses(plain, poses), 1, 1);
  EXPECT_NEAR(a, b, 0.02 * b);
}

// The derivative of the cost of smoothness, base and all, by finite differences.
TEST(Edit, SmoothnessOfTheBaseHasItsGradient) {
  const Scene scene = Turning(300, 20);
  const Smoothness smoothness(scene, Settings());
  std::mt19937 random(5);
  MatX edit = 0.1 * RandomMatrix(scene.num_coordinates(), kFrames, &random);
  const auto cost = [&] {
    return smoothness.HalfSquares(edit, 0, kFrames, true) +
           smoothness.HalfSquares(edit, 0, kFrames, false);
  };
  for (const int t : {0, 1, 30, kFrames - 1}) {
    VecX g = VecX::Zero(scene.num_coordinates());
    smoothness.AddGradient(edit, t, g);
    for (const int c : {0, 2, 3, 4, 5, scene.FirstCoordinate(1) + 4, 20}) {
      const double h = 1e-4, here = edit(c, t);
      edit(c, t) = here + h;
      const double up = cost();
      edit(c, t) = here - h;
      const double down = cost();
      edit(c, t) = here;
      EXPECT_NEAR((up - down) / (2 * h), g[c], 1e-5 * (1 + std::abs(g[c]))) << t << " " << c;
    }
  }
}

TEST(Edit, ASolveFollowsATurnAllTheWayRound) {
  Settings settings;
  settings.solve.threads = 1;
  for (const bool follow : {false, true}) {
    for (const double degrees : {300.0, -360.0}) {
      const double tilt = degrees > 0 ? 0 : 20;
      const Scene scene = Turning(degrees, tilt, follow);
      const Problem problem(scene, settings);
      const SolveResult solved = SolveSpacetime(problem, TemplateStart(problem), nullptr);
      EXPECT_EQ(solved.status, SolveStatus::kConverged);
      EXPECT_GT(solved.history.back().smallest_gli, 0.5);
      EXPECT_LT(solved.history.back().deepest_penetration_m, 0.02);
      EXPECT_LT(LargestLeap(solved.unknowns.edit), 0.5) << degrees << " " << follow;
      const double own =
          std::max(LargestStep(scene.source[0].frames), LargestStep(scene.source[1].frames));
      const std::array<Clip, 2> clips = EditedClips(scene, solved.unknowns);
      for (int f = 0; f < 2; ++f) {
        EXPECT_LT(LargestStep(clips[f].frames), 1.5 * own) << degrees << " " << follow << " " << f;
      }
      // Together all the way.
      const auto& laid = scene.posture.pose;
      const Quat was = laid[0].rotation[0].conjugate() * laid[1].rotation[0];
      for (int t = 0; t < kFrames; ++t) {
        const Quat is = clips[0].frames[t].rotation[0].conjugate() * clips[1].frames[t].rotation[0];
        EXPECT_LT(LogSo3(was.conjugate() * is).norm(), 0.5) << degrees << " " << follow << " " << t;
      }
    }
  }
}

}  // namespace
}  // namespace retarget::solver
