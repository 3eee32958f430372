// Damaged motions that look right at their keys: a limb that goes through a limb and back within
// one interval, a tag that is lost for 2 ms, a hold that opens, and depth, between keys. Each must
// be found, by the proof and by the second checker.
#include <gtest/gtest.h>

#include "solver/metrics/requirements.h"
#include "tests/solver/proof/proof_fixture.h"

namespace retarget::solver {
namespace {

constexpr int kEach = 50;
constexpr int kFold = 4096;
constexpr int kWindow = 246;  // samples: 2 ms at 30 keys/s

// All limits so wide that nothing is lost.
Requirements Wide() {
  Requirements r;
  r.gli = -10;
  r.penetration_m = r.hold_m = r.floor_m = r.foot_drift_m = 10;
  r.penetration_1cm_percent = 100;
  r.plausible = {10, 360, 10, 360, 1e9};
  return r;
}

struct Found {
  int by_proof = 0, by_second = 0, by_samples = 0, made = 0;
};

// `from`, `to`: when the damage is there (s).
void Judge(const RandomScene& s, RequirementKind kind, double from, double to, Found* found) {
  ++found->made;
  const Proof proof = Prove(s.task());
  EXPECT_FALSE(proof.proved());
  const double grain = kSmallestStretch / 30 + 1.5 / kFold / 30;
  for (const Finding& f : proof.findings) {
    const Statement& of = proof.statements[static_cast<size_t>(f.statement)];
    if (of.kind != kind) continue;
    if (f.time_s < from - grain || f.time_s > to + grain) continue;
    ++found->by_proof;
    break;
  }
  const Advancement second = CheckByAdvancement(s.task(), proof.statements);
  found->by_second += std::any_of(second.failures.begin(), second.failures.end(),
                                  [&](const auto& f) { return f.kind == kind; });
  const MotionView view = ViewOf(s);
  found->by_samples +=
      !AllMet(CheckRequirements(s.subject, Measure(s.subject, view, view), s.limits));
}

// An upright forearm goes round its elbow's circle, through a pole and back, while the circle
// bulges over it. The keys before and after stand still.
RandomScene ThroughAndBack(SceneMaker* make, double* from, double* to) {
  RandomScene s = make->Make(4, 0, 0, 0);
  s.subject.tangles.clear();
  s.limits = Wide();
  s.limits.penetration_m = 0.02;
  const double reach = make->Uniform(0.25, 0.4), sweep = make->Uniform(1.8, 3);
  // Between two of the instants that samples look at, most of the time.
  const double middle = 0.375 + 0.25 * make->Uniform(-0.6, 0.6), width = make->Uniform(0.01, 0.05);
  const double radius = make->Uniform(0.0105, 0.016);
  const Vec3 offset_a[] = {{0, 0, 0}, {reach, 0, 0}, {0, 0, 0.2}, {0, 0, -0.2}, {0, 0, -0.2}};
  const Vec3 offset_b[] = {{0, 0, 0}, {0, 1, 0}, {0, 0.2, 0}, {0, 0, 0.3}, {0, 0, 0.2}};
  const Quat world = ExpSo3(make->Uniform(0, 3) * make->Direction());
  for (size_t n = 0; n < 10; ++n) {
    s.motion.nodes[n].translation = n < 5 ? offset_a[n] : offset_b[n - 5];
    for (Quat& q : s.motion.rotation_tracks[n]) q.setIdentity();
    Node& node = s.subject.body[n / 5].nodes[n % 5];
    if (node.parent >= 0) node.radius = radius;
    s.subject.length[n / 5][n % 5] = s.motion.nodes[n].translation.norm();
  }
  for (size_t k = 0; k < 4; ++k) {
    const double angle = sweep * ((k < 2 ? 0 : 1) - middle);
    s.motion.rotation_tracks[0][k] = world * Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
    s.motion.rotation_tracks[5][k] = world;
    s.motion.translation_tracks[0][k] = world * Vec3(0, 0, 1);
    s.motion.translation_tracks[1][k] = world * Vec3(reach * std::cos(sweep * width), -0.5, 1.1);
  }
  for (std::vector<Vec3>& track : s.motion.translation_tracks) {
    for (Vec3& p : track) p.y() += 3;  // clear of the floor
  }
  *from = (1 + middle - width) / 30;
  *to = (1 + middle + width) / 30;
  return s;
}

TEST(Liars, ALimbThroughALimbAndBack) {
  SceneMaker make(31);
  Found found;
  for (int k = 0; k < kEach; ++k) {
    double from = 0, to = 0;
    const RandomScene s = ThroughAndBack(&make, &from, &to);
    Judge(s, RequirementKind::kPassThroughs, from, to, &found);
  }
  EXPECT_EQ(found.by_proof, kEach);
  EXPECT_EQ(found.by_second, kEach);
  EXPECT_LT(found.by_samples, kEach);
  std::printf("through and back: samples find %d of %d\n", found.by_samples, kEach);
}

// A random motion whose worst value is inside its middle interval, and how it is damaged: the limit
// is set to what is overstepped for about 2 ms.
template <typename Value, typename SetLimit>
Found JudgeDips(unsigned seed, RequirementKind kind, const Value& value,
                const SetLimit& set_limit) {
  SceneMaker make(seed);
  Found found;
  for (int trial = 0; trial < 20000 && found.made < kEach; ++trial) {
    RandomScene s = make.Make(4, make.Uniform(0.1, 0.8), 0.05, 0.25);
    s.limits = Wide();
    s.subject.holds = {Hold{{0, 2, make.Within(0.05)}, {1, 2, make.Within(0.05)}, false, {}}};
    const PostureSample start = PlacesAt(s, 0, 0);
    s.subject.tangles[0].sign = WorstBetween(s, start, start).gli < 0 ? -1 : 1;
    // A rough look first.
    double peak = -1e9, elsewhere = -1e9;
    int at = 0;
    for (int k = 0; k <= 3 * 24; ++k) {
      const double v = value(
          WorstBetween(s, PlacesAt(s, std::min(k / 24, 2), k < 72 ? k % 24 / 24.0 : 1), start));
      if (v > peak) {
        peak = v;
        at = k;
      }
    }
    if (at < 24 + 2 || at > 48 - 2) continue;
    std::vector<double> series;
    for (int k = 0; k <= kFold; ++k) {
      series.push_back(
          value(WorstBetween(s, PlacesAt(s, 1, static_cast<double>(k) / kFold), start)));
    }
    const auto top = std::max_element(series.begin(), series.end()) - series.begin();
    if (top < 2 * kWindow || top > kFold - 2 * kWindow) continue;
    const double limit = std::max(series[static_cast<size_t>(top - kWindow / 2)],
                                  series[static_cast<size_t>(top + kWindow / 2)]);
    if (series[static_cast<size_t>(top)] - limit < 1e-5 || !(limit > 1e-4 || limit < 0)) continue;
    // Everywhere else the limit is kept, and nothing passes through.
    MatX before;
    double jump = 0;
    for (int k = 0; k <= 3 * 256; ++k) {
      const PostureSample now = PlacesAt(s, std::min(k / 256, 2), k < 768 ? k % 256 / 256.0 : 1);
      const MatX gli = PairGlis(s, now);
      if (k > 0) jump = std::max(jump, (gli - before).cwiseAbs().maxCoeff());
      before = gli;
      if (k < 256 || k > 512) elsewhere = std::max(elsewhere, value(WorstBetween(s, now, start)));
    }
    if (jump > 0.5 || elsewhere > limit - 1e-6) continue;
    set_limit(limit, &s.limits);
    size_t first = 0, last = series.size() - 1;
    while (series[first] <= limit) ++first;
    while (series[last] <= limit) --last;
    Judge(s, kind, (1 + double(first) / kFold) / 30, (1 + double(last) / kFold) / 30, &found);
  }
  return found;
}

void ExpectAllFound(const Found& found, const char* what) {
  EXPECT_EQ(found.made, kEach);
  EXPECT_EQ(found.by_proof, kEach);
  EXPECT_EQ(found.by_second, kEach);
  EXPECT_LT(found.by_samples, kEach);
  std::printf("%s: samples find %d of %d\n", what, found.by_samples, found.made);
}

TEST(Liars, ATagLostForTwoMilliseconds) {
  ExpectAllFound(JudgeDips(
                     32, RequirementKind::kTangle, [](const Worst& w) { return -w.gli; },
                     [](double limit, Requirements* r) { r->gli = -limit; }),
                 "tag lost for 2 ms");
}

TEST(Liars, AHoldThatOpensBetweenKeys) {
  ExpectAllFound(JudgeDips(
                     33, RequirementKind::kHold, [](const Worst& w) { return w.hold; },
                     [](double limit, Requirements* r) { r->hold_m = limit; }),
                 "hold open for 2 ms");
}

TEST(Liars, DepthBetweenKeys) {
  ExpectAllFound(JudgeDips(
                     34, RequirementKind::kPenetration, [](const Worst& w) { return w.depth; },
                     [](double limit, Requirements* r) { r->penetration_m = limit; }),
                 "depth for 2 ms");
}

}  // namespace
}  // namespace retarget::solver
