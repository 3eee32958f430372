// What is certified is so: random motions of two figures against dense sampling, and against the
// second checker.
#include <gtest/gtest.h>

#include "tests/solver/proof/proof_fixture.h"

namespace retarget::solver {
namespace {

constexpr int kFold = 4096;

// Gives a random scene something of everything to keep, with limits near what it does.
RandomScene SceneWithLimits(SceneMaker* make) {
  RandomScene s = make->Make(3, std::pow(10.0, make->Uniform(-2, 0.2)),
                             std::pow(10.0, make->Uniform(-3, -0.7)), make->Uniform(0.1, 0.5));
  for (std::vector<Vec3>& track : s.motion.translation_tracks) {
    for (Vec3& p : track) p.y() -= 0.7;
  }
  Hold hold;
  hold.from = {0, 2, make->Within(0.05)};
  hold.to = {1, 4, make->Within(0.05)};
  s.subject.holds = {hold};
  hold.to = {kWorld, 0, make->Within(0.5) + Vec3(0, 0.3, 0)};
  s.subject.holds.push_back(hold);
  s.subject.contacts[0] = {{4, 0, 2}};
  const PostureSample start = PlacesAt(s, 0, 0);
  s.subject.tangles[0].sign = WorstBetween(s, start, start).gli < 0 ? -1 : 1;
  const Worst w = WorstBetween(s, start, start);
  s.limits.gli = w.gli - make->Uniform(0.005, 0.15);
  s.limits.penetration_m = std::max(0.0, w.depth + make->Uniform(-0.01, 0.02));
  s.limits.hold_m = w.hold + make->Uniform(0, 0.1);
  s.limits.floor_m = w.floor + make->Uniform(0, 0.05);
  s.limits.foot_drift_m = make->Uniform(0, 0.1);
  return s;
}

struct Counts {
  int certified = 0, open = 0, proved = 0, confirmed = 0, undecided = 0;
  long halved = 0;
};

// Every bound of every interval against samples.
void CheckIntervals(const RandomScene& s, const Proof& proof, Counts* counts) {
  const PostureSample start = PlacesAt(s, 0, 0);
  for (int key = 0; key < 2; ++key) {
    const IntervalProof& interval = proof.intervals[static_cast<size_t>(key)];
    Worst worst;
    double jump = 0;
    MatX before;
    for (int k = 0; k <= kFold; ++k) {
      const PostureSample now = PlacesAt(s, key, static_cast<double>(k) / kFold);
      worst.Take(WorstBetween(s, now, start));
      const MatX gli = PairGlis(s, now);
      if (k > 0) jump = std::max(jump, (gli - before).cwiseAbs().maxCoeff());
      before = gli;
    }
    double hold = 0;
    for (size_t k = 0; k < proof.statements.size(); ++k) {
      const Statement& of = proof.statements[k];
      const double bound = interval.bound[k];
      if (!std::isfinite(bound)) {
        if (of.kind == RequirementKind::kHold) hold = bound;
        ++counts->open;
        continue;
      }
      ++counts->certified;
      switch (of.kind) {
        case RequirementKind::kTangle:
          EXPECT_GE(worst.gli, bound);
          EXPECT_GE(bound, of.limit);
          break;
        case RequirementKind::kPassThroughs:
          EXPECT_LT(jump, 0.5);
          break;
        case RequirementKind::kPenetration:
          EXPECT_LE(worst.depth, bound);
          EXPECT_LE(bound, of.limit);
          break;
        case RequirementKind::kHold:
          hold = std::max(hold, bound);
          EXPECT_LE(bound, of.limit);
          if (of.item == 1) {
            EXPECT_LE(worst.hold, hold);
          }
          break;
        case RequirementKind::kFloor:
          if (of.figure == 1) {
            EXPECT_LE(worst.floor, std::max(bound, interval.bound[k - 3]));
          }
          break;
        case RequirementKind::kFootDrift:
          if (of.figure == 0) {
            EXPECT_LE(worst.drift, bound);
          }
          break;
        default:
          break;
      }
    }
    counts->halved += interval.depth > 0;
  }
}

void CheckSecond(const RandomScene& s, const Proof& proof, Counts* counts) {
  const Advancement second = CheckByAdvancement(s.task(), proof.statements);
  if (proof.proved()) {
    EXPECT_TRUE(second.failures.empty());
    ++counts->proved;
  }
  for (const Finding& finding : proof.findings) {
    if (!finding.lost) {
      ++counts->undecided;
      continue;
    }
    const Statement& of = proof.statements[static_cast<size_t>(finding.statement)];
    EXPECT_TRUE(std::any_of(second.failures.begin(), second.failures.end(),
                            [&](const auto& f) {
                              // A limb that goes through a limb ends what it knows of tags.
                              const bool ends_tags = of.kind == RequirementKind::kTangle &&
                                                     f.kind == RequirementKind::kPassThroughs;
                              return ends_tags || (f.kind == of.kind && f.item == of.item &&
                                                   f.figure == of.figure);
                            }))
        << static_cast<int>(of.kind) << " is lost, the second checker does not see it";
    ++counts->confirmed;
  }
  ASSERT_EQ(second.worst.size(), proof.intervals.size());
}

Counts CheckRandomMotions(unsigned first_seed, int motions) {
  Counts counts;
  for (int k = 0; k < motions && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE("seed " + std::to_string(first_seed + static_cast<unsigned>(k)));
    SceneMaker make(first_seed + static_cast<unsigned>(k));
    const RandomScene s = SceneWithLimits(&make);
    const Proof proof = Prove(s.task());
    CheckIntervals(s, proof, &counts);
    CheckSecond(s, proof, &counts);
  }
  return counts;
}

void ExpectEverythingHappened(const Counts& c, int motions) {
  EXPECT_GT(c.certified, 10 * motions);
  EXPECT_GT(c.open, motions / 5);
  EXPECT_GT(c.proved, motions / 10);
  EXPECT_GT(c.confirmed, motions / 5);
  EXPECT_GT(c.halved, motions / 5);
  std::printf(
      "%d bounds certified, %d open, %d motions proved, %d losses confirmed by the second "
      "checker, %d undecided\n",
      c.certified, c.open, c.proved, c.confirmed, c.undecided);
}

TEST(Soundness, CertifiedIntervalsAreFreeInRandomMotions) {
  ExpectEverythingHappened(CheckRandomMotions(1000, 150), 150);
}

TEST(NightlySoundness, CertifiedIntervalsAreFreeInTenThousandMotions) {
  ExpectEverythingHappened(CheckRandomMotions(100000, 10000), 10000);
}

}  // namespace
}  // namespace retarget::solver
