// The second checker: the same statements as solver/proof/proof.h by conservative advancement
// (Mirtich 1996 for collisions; here for every statement), written apart from the prover. It shares
// with it what a proof is about (ProofTask) and nothing else: neither playback, bounds, distances
// nor GLI.
//
// At an instant u it knows every point's place, its exact velocity v (derivative of the forward
// kinematics) and a bound A on its acceleration. A statement with slack c cannot fail before u + h
// where |v| h + A h^2 / 2 <= c, v relative between what it compares. There it is looked at again.
#pragma once

#include <vector>

#include "solver/proof/proof.h"

namespace retarget::solver {

struct AdvancementFailure {
  RequirementKind kind = RequirementKind::kTangle;
  int item = -1, figure = -1;
  double time_s = 0;  // where no step forward is possible
  double value = 0;   // there, in the requirement's unit; s GLI; of a pass-through the distance
  std::vector<LimbNode> limbs = {};
};

struct Advancement {
  std::vector<AdvancementFailure> failures;  // the first of every claim in an interval
  long instants = 0;                         // looked at
  // The worst value of each statement that was met between a key and the next: what a bound claimed
  // for that interval may not contradict. [intervals][statements]
  std::vector<std::vector<double>> worst;
};

// `most_instants` bounds the work between two keys; what needs more fails. `statements` say what
// `worst` is about.
Advancement CheckByAdvancement(const ProofTask& task, const std::vector<Statement>& statements,
                               int most_instants = 20000);

}  // namespace retarget::solver
