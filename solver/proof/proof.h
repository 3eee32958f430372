// What a motion keeps at every instant, not at sampled ones: proved from bounds on its points'
// motion between two keys, with the stretch of time halved where the bounds do not suffice
// (docs/proof.md). The motion is that of the written file.
#pragma once

#include <array>
#include <vector>

#include "model/rig/keyed_motion.h"
#include "model/settings.h"
#include "solver/metrics/requirements.h"

namespace retarget::solver {

// Stretches are halved down to this part of the way between two keys. What is then undecided is a
// finding: within that time a limit is touched.
inline constexpr double kSmallestStretch = 1.0 / 4096;

// None is owned. `node` are the nodes of the motion that the nodes of the bodies are, `subject`
// says what is held, and `limits` how well.
struct ProofTask {
  const KeyedMotion& motion;
  const std::array<std::vector<int>, 2>& node;
  const MetricsContext& subject;
  const Requirements& limits;
};

// One statement, about all t: "s GLI of tag 2 stays above 0.5".
struct Statement {
  RequirementKind kind = RequirementKind::kTangle;
  int item = -1;    // tag or hold; -1: it is about neither
  int figure = -1;  // 0 or 1; -1: about both
  double limit = 0;
  double value = 0;  // worst that was met at an instant looked at; of pass-throughs the count; NaN:
                     // there was nothing to look at
  double bound = 0;  // proved for all t: s GLI is nowhere below it, the others nowhere above
  bool proved = true;
  int frame = -1;                    // key at or before the instant of `value`
  std::vector<LimbNode> limbs = {};  // concerned there
};

// Where a statement fails or cannot be decided: one per claim (a pair of limbs, a tag, ...).
struct Finding {
  int statement = 0;
  bool lost = true;  // a value beyond the limit was met; false: not decided in the smallest stretch
  double time_s = 0;  // the first instant
  int frame = 0;      // key at or before it
  double value = 0;   // there, in the statement's unit; of a pass-through the axes' distance (m)
  double worst = 0;   // that was met later
  double worst_s = 0;
  int intervals = 0;  // between keys, in which it is so
  std::vector<LimbNode> limbs = {};
};

// From one key to the next.
struct IntervalProof {
  int depth = 0;              // halvings
  int evaluations = 1;        // stretches that were looked at
  std::vector<double> bound;  // [statements] as Statement::bound
};

struct Proof {
  std::vector<Statement> statements;
  std::vector<IntervalProof> intervals;
  std::vector<Finding> findings;  // by time
  long evaluations = 0;
  int depth = 0;
  double seconds = 0;

  bool proved() const { return findings.empty(); }
};

Proof Prove(const ProofTask& task);

// Requirements judged by what is proved: `checks` get the worst of both values, the proved bound,
// and are met only where the statement is proved.
void JudgeByProof(const Proof& proof, std::vector<RequirementCheck>* checks);

}  // namespace retarget::solver
