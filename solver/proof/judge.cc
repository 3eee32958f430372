// JudgeByProof of solver/proof/proof.h.
#include <algorithm>

#include "solver/proof/proof.h"

namespace retarget::solver {
namespace {

bool IsWorse(const Statement& statement, double value) {
  return statement.kind == RequirementKind::kTangle ? statement.value < value
                                                    : statement.value > value;
}

}  // namespace

void JudgeByProof(const Proof& proof, std::vector<RequirementCheck>* checks) {
  for (RequirementCheck& check : *checks) {
    const auto statement =
        std::find_if(proof.statements.begin(), proof.statements.end(), [&](const Statement& s) {
          return s.kind == check.kind && s.item == check.item && s.figure == check.figure;
        });
    if (statement == proof.statements.end()) continue;
    check.met = statement->proved;
    if (statement->proved) check.bound = statement->bound;
    // Samples see limbs that pass each other fast as a pass-through; the proof knows better.
    const bool counted = check.kind == RequirementKind::kPassThroughs;
    if (!counted && !IsWorse(*statement, check.value)) continue;
    check.value = statement->value;
    check.frame = statement->frame;
    check.limbs = statement->limbs;
  }
}

}  // namespace retarget::solver
