// Every term's analytic Jacobian against central differences in the coordinates of the edit, at the
// source, and at random edits, on the active side of its hinges; and tracking against its
// definition.
#include <gtest/gtest.h>

#include <map>

#include "solver/problem/problem.h"
#include "solver/problem/terms/pose_tracking.h"
#include "solver/problem/terms/ray.h"
#include "solver/problem/terms/root_tracking.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

constexpr double kStep = 1e-6;
constexpr double kTolerance =
    2e-7;  // relative to the row's largest entry, plus the same absolutely

struct Checked {
  int rows = 0, entries = 0, nonzero = 0, skipped = 0;
};

// All residuals of a term in one frame, hinge rows and coordinate rows.
std::vector<double> Residuals(const Term& term, const Scene& scene, const Unknowns& u, int t) {
  Frame frame;
  frame.Set(scene, u, t, false);
  Rows rows;
  rows.Reset(frame, false);
  term.Evaluate(frame, &rows);
  std::vector<double> r = rows.residual();
  for (const auto& c : rows.coordinates()) r.push_back(c.residual);
  return r;
}

// [rows x (coordinates + 2 anchors)] of the same rows.
MatX Jacobian(const Term& term, const Scene& scene, const Unknowns& u, int t) {
  Frame frame;
  frame.Set(scene, u, t, true);
  Rows rows;
  rows.Reset(frame, true);
  term.Evaluate(frame, &rows);
  const long n = scene.num_coordinates();
  const long m = rows.num_rows();
  MatX j = MatX::Zero(m + static_cast<long>(rows.coordinates().size()), n + u.anchor.size());
  j.topLeftCorner(m, n) = rows.jacobian();
  for (const auto& e : rows.anchors()) j(e.row, n + 2 * e.anchor + e.component) += e.value;
  for (size_t k = 0; k < rows.coordinates().size(); ++k) {
    j(m + static_cast<long>(k), rows.coordinates()[k].coordinate) =
        rows.coordinates()[k].derivative;
  }
  return j;
}

void CheckFrame(const Term& term, const Scene& scene, const Unknowns& u, int t, Checked* checked) {
  const std::vector<double> r0 = Residuals(term, scene, u, t);
  if (r0.empty()) return;
  const MatX j = Jacobian(term, scene, u, t);
  ASSERT_EQ(static_cast<size_t>(j.rows()), r0.size()) << term.name();
  const long n = scene.num_coordinates();
  MatX numeric = MatX::Zero(j.rows(), j.cols());
  for (long c = 0; c < j.cols(); ++c) {
    Unknowns plus = u, minus = u;
    if (c < n) {
      plus.edit(c, t) += kStep;
      minus.edit(c, t) -= kStep;
    } else {
      plus.anchor(c - n) += kStep;
      minus.anchor(c - n) -= kStep;
    }
    const std::vector<double> rp = Residuals(term, scene, plus, t);
    const std::vector<double> rm = Residuals(term, scene, minus, t);
    if (rp.size() != r0.size() || rm.size() != r0.size()) {  // a hinge switched within the step
      ++checked->skipped;
      return;
    }
    for (long k = 0; k < j.rows(); ++k) numeric(k, c) = (rp[k] - rm[k]) / (2 * kStep);
  }
  for (long k = 0; k < j.rows(); ++k) {
    const double scale = 1 + j.row(k).cwiseAbs().maxCoeff();
    for (long c = 0; c < j.cols(); ++c) {
      ASSERT_NEAR(j(k, c), numeric(k, c), kTolerance * scale)
          << term.name() << " frame " << t << " row " << k << " coordinate " << c;
      ++checked->entries;
      checked->nonzero += j(k, c) != 0;
    }
    ++checked->rows;
  }
}

Unknowns RandomEdit(const Scene& scene, double size, unsigned seed) {
  Unknowns u = UnknownsFromPoses(scene, scene.source);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (long i = 0; i < u.edit.size(); ++i) u.edit(i) = size * normal(random);
  for (long i = 0; i < u.anchor.size(); ++i) u.anchor(i) += 0.05 * normal(random);
  return u;
}

TEST(Terms, AnalyticJacobiansMatchCentralDifferences) {
  std::map<std::string, Checked> checked;
  for (const std::string roots : {"own", "follow", "drift", "steps"}) {
    Scene scene = SmallScene(4, 0.2, roots == "follow");
    for (int f = 0; f < 2 && roots == "steps"; ++f) {  // from footprint to footprint
      const int ankle = scene.body[f].FindNode("right_ankle"),
                toe = scene.body[f].FindNode("right_toe");
      scene.contacts[f] = {{ankle, 0, 0}, {ankle, 3, 3}, {toe, 0, 0}, {toe, 2, 3}};
    }
    for (int t = 0; t < 4 && roots == "drift"; ++t) {  // b walks and turns away from a
      Pose& b = scene.source[1].frames[t];
      b.root_position += Vec3(0.1 * t, 0, 0.2 * t);
      b.rotation[0] = YawRotation(0.3 * t) * b.rotation[0];
    }
    // An elbow that only bends, an ankle of two axes.
    for (int f = 0; f < 2; ++f) {
      const int elbow = scene.body[f].FindLink("left_elbow");
      const int ankle = scene.body[f].FindLink("right_ankle");
      scene.locked_axes[f].assign(
          4, {{elbow, Vec3(0.6, 0.8, 0)}, {elbow, Vec3(0, 0, 1)}, {ankle, Vec3(1, 2, -2) / 3}});
    }
    for (HandContact c : FindHandContacts(scene.body,
                                          {PoseBody(scene.body[0], scene.posture.pose[0]),
                                           PoseBody(scene.body[1], scene.posture.pose[1])},
                                          1)) {
      scene.hand_contacts.push_back(c);
      c.along = c.to_along = 0.3;
      scene.hand_contacts.push_back(c);
    }
    ASSERT_EQ(scene.hand_contacts.size(), 8u);
    const Problem problem(scene, {});
    for (unsigned seed = 0; seed < 11; ++seed) {
      const Unknowns u = RandomEdit(scene, seed == 0 ? 0 : 0.25, seed);
      for (const auto& [term, weight] : problem.terms()) {
        for (int t = 0; t < scene.num_frames(); ++t) {
          CheckFrame(*term, scene, u, t, &checked[term->name()]);
        }
      }
    }
  }
  for (const auto& term : {"pose_tracking", "root_tracking", "foot_lock", "foot_swing", "hold",
                           "penetration", "self_penetration", "ground", "tangle", "tangle_aim",
                           "hand_contact", "joint_limit", "rig_turn"}) {
    const Checked& c = checked[term];
    std::printf("%-17s %6d rows %8d entries %7d not zero %3d frames skipped\n", term, c.rows,
                c.entries, c.nonzero, c.skipped);
    EXPECT_GT(c.rows, 20) << term;
    EXPECT_GT(c.nonzero, 60) << term;
  }
  EXPECT_EQ(checked.size(), 13u);
}

TEST(Terms, PartsAreOfTheSceneAndAddUpToTheTerm) {
  const Scene scene = SmallScene(5, 0.2);
  const Problem problem(scene, {});
  const Unknowns u = RandomEdit(scene, 0.1, 2);
  std::map<PartKind, int> kinds;
  int always_on = 0;
  for (const auto& [term, weight] : problem.terms()) {
    ++kinds[term->part_kind()];
    const size_t parts = static_cast<size_t>(term->parts(scene));
    switch (term->part_kind()) {
      case PartKind::kWhole:
        EXPECT_EQ(parts, 1u) << term->name();
        break;
      case PartKind::kHold:
        EXPECT_EQ(parts, scene.holds.size());
        break;
      case PartKind::kTag:
        EXPECT_EQ(parts, scene.tangles.size());
        break;
      case PartKind::kContact:
        EXPECT_EQ(static_cast<long>(parts), u.anchor.cols());
        break;
    }
    for (int t = 0; t < scene.num_frames(); ++t) {
      Frame frame;
      frame.Set(scene, u, t, false);
      std::vector<double> of_parts;
      for (size_t part = 0; part < parts; ++part) {
        Rows rows;
        rows.Reset(frame, false);
        term->EvaluatePart(frame, static_cast<int>(part), &rows);
        of_parts.insert(of_parts.end(), rows.residual().begin(), rows.residual().end());
      }
      Rows whole;
      whole.Reset(frame, false);
      term->Evaluate(frame, &whole);
      EXPECT_EQ(of_parts, whole.residual()) << term->name();
      const std::string name = term->name();
      if (name == "foot_lock" || name == "foot_swing" || name == "root_tracking" ||
          name == "pose_tracking") {
        EXPECT_EQ(term->row_slots(frame), whole.num_rows()) << name;
        always_on += whole.num_rows();
      }
    }
  }
  EXPECT_EQ(kinds[PartKind::kHold], 1);
  EXPECT_EQ(kinds[PartKind::kTag], 2);  // tangle and tangle_aim
  EXPECT_EQ(kinds[PartKind::kContact], 2);
  EXPECT_GT(always_on, 20);
}

TEST(Terms, RaysHaveTheirJacobianAndMeasureTheDistance) {
  const Scene scene = SmallScene(4, 0.2);
  std::vector<NodeRay> rays;
  for (const int f : {0, 1}) {
    for (const int node : {0, 4, 8, 12, 20}) {
      rays.push_back({f, node, Vec3(0.3 * f, 1, 2), Vec3(0.1 * node, -0.2, -0.5 - f)});
    }
  }
  const RayTerm term(rays);
  Checked checked;
  for (unsigned seed = 0; seed < 6; ++seed) {
    const Unknowns u = RandomEdit(scene, seed == 0 ? 0 : 0.25, seed);
    for (int t = 0; t < scene.num_frames(); ++t) {
      CheckFrame(term, scene, u, t, &checked);
      Frame frame;
      frame.Set(scene, u, t, false);
      const std::vector<double> r = Residuals(term, scene, u, t);
      for (size_t k = 0; k < rays.size(); ++k) {
        const Vec3 from = frame.posed[rays[k].figure].node[rays[k].node] - rays[k].origin;
        const double distance = from.cross(rays[k].direction).norm() / rays[k].direction.norm();
        EXPECT_NEAR(std::hypot(r[2 * k], r[2 * k + 1]), distance, 1e-12);
      }
    }
  }
  EXPECT_EQ(checked.rows, 6 * 4 * 20);
  EXPECT_GT(checked.nonzero, 1000);
}

TEST(Terms, SmoothnessGradientAndStencilMatchTheCost) {
  const Scene scene = SmallScene(7, 0.2);
  const Smoothness smoothness(scene, {});
  const Unknowns u = RandomEdit(scene, 0.2, 3);
  const auto cost = [&](const MatX& edit) {
    return smoothness.HalfSquares(edit, 0, 7, false) + smoothness.HalfSquares(edit, 0, 7, true);
  };
  int checked = 0;
  for (int t = 0; t < 7; ++t) {
    VecX g = VecX::Zero(scene.num_coordinates());
    smoothness.AddGradient(u.edit, t, g);
    for (int c = 0; c < scene.num_coordinates(); c += 7) {
      MatX plus = u.edit, minus = u.edit;
      plus(c, t) += 1e-4;
      minus(c, t) -= 1e-4;
      EXPECT_NEAR(g[c], (cost(plus) - cost(minus)) / 2e-4, 1e-5 * (1 + std::abs(g[c])));
      ++checked;
      // The Hessian of a quadratic from second differences of the cost, lag 0, 1 and 2.
      for (int lag = 0; lag <= 2 && t + lag < 7; ++lag) {
        MatX pp = u.edit, pm = u.edit, mp = u.edit, mm = u.edit;
        pp(c, t) += 0.1, pp(c, t + lag) += 0.1;
        pm(c, t) += 0.1, pm(c, t + lag) -= 0.1;
        mp(c, t) -= 0.1, mp(c, t + lag) += 0.1;
        mm(c, t) -= 0.1, mm(c, t + lag) -= 0.1;
        const double second = (cost(pp) - cost(pm) - cost(mp) + cost(mm)) / 0.04;
        const double w = smoothness.weight()[c];
        EXPECT_NEAR(w * w * Smoothness::StencilProduct(7, t, lag), second, 1e-6 * w * w);
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 400);
}

Eigen::Isometry3d RootOf(const Pose& pose) {
  return Eigen::Translation3d(pose.root_position) * pose.rotation[0];
}

// The terms' own definition, from the poses: turns of the joints from the source's, and how far
// each root is from where its clip, or the partner whom it follows, wants it.
double TrackingCost(const Scene& scene, const Settings& settings,
                    const std::array<Clip, 2>& moved) {
  double cost = 0;
  for (int f = 0; f < 2; ++f) {
    for (int t = 0; t < scene.num_frames(); ++t) {
      const Pose &is = moved[f].frames[t], &source = scene.source[f].frames[t];
      for (size_t l = 1; l < is.rotation.size(); ++l) {
        const double turn = is.rotation[l].angularDistance(source.rotation[l]);
        const double share = JointShare(settings.joint_weights, scene.body[f].links[l].name);
        cost += 0.5 * std::pow(settings.weights.pose_tracking * share * turn, 2);
      }
      Eigen::Isometry3d target = RootOf(source);
      if (scene.root[f] == RootReference::kPartner) {
        target = RootOf(moved[1 - f].frames[t]) * RootOf(scene.posture.pose[1 - f]).inverse() *
                 RootOf(scene.posture.pose[f]) *
                 RootOf(scene.source[f].frames[scene.template_frame]).inverse() * RootOf(source);
      }
      const double off = (is.root_position - target.translation()).norm();
      const double turn = is.rotation[0].angularDistance(Quat(target.rotation()));
      cost += 0.5 * std::pow(settings.weights.root_tracking, 2) * (off * off + turn * turn);
    }
  }
  return cost;
}

TEST(Terms, TrackingIsTheDistanceFromTheSource) {
  Settings settings;
  const double pose_weight = settings.weights.pose_tracking;
  settings.weights = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  settings.weights.pose_tracking = pose_weight;
  settings.weights.root_tracking = 6;
  for (const bool follow : {false, true}) {
    Scene scene = SmallScene(5, 0.2, follow);
    scene.template_frame = 2;
    const Problem problem(scene, settings);
    std::array<Clip, 2> moved;
    for (int f = 0; f < 2; ++f) {
      moved[f] = Fidget(scene.body[f], scene.posture.pose[f], 5, 30, 91 + f, 0.3);
    }
    for (const auto& clips : {moved, scene.source}) {
      const double expected = TrackingCost(scene, settings, clips);
      EXPECT_NEAR(problem.Cost(UnknownsFromPoses(scene, clips), 1, 1), expected,
                  1e-12 + 1e-9 * expected)
          << "follow " << follow;
    }
    EXPECT_GT(TrackingCost(scene, settings, moved), 1);
    EXPECT_EQ(TrackingCost(scene, settings, scene.source) < 1e-20, !follow)
        << "a follower leaves its clip";
  }
}

}  // namespace
}  // namespace retarget::solver
