// A conflict in words: what is missed where, what pulls against it, and what to do about it.
#pragma once

#include <string>

#include "solver/metrics/diagnosis.h"

namespace retarget::solver {

struct ConflictCase {
  const Problem& problem;
  const Unknowns& unknowns;
  const MeasureSubject& subject;
  const Metrics& metrics;
  const RequirementCheck& check;
  const Opposition& opposition;
};
std::string ConflictSentence(const ConflictCase& c);

// What the clips and the template themselves ask for that no weight can settle: two planted feet in
// one place, or a hold out of reach of the feet. Empty where there is no such thing.
std::string ContradictionInData(const ConflictCase& c);

// "a left_hand"
std::string LimbName(const std::array<Body, 2>& body, const LimbNode& limb);

// The contact that stands on an anchor (column of Unknowns::anchor).
struct AnchoredContact {
  int figure = 0;
  Contact contact;
};
AnchoredContact ContactOfAnchor(const Scene& scene, int anchor);
// "b left_ankle, planted in frames 40 to 120"
std::string PlantedName(const Scene& scene, const AnchoredContact& planted);

// printf into a string.
__attribute__((format(printf, 1, 2))) std::string Text(const char* format, ...);

}  // namespace retarget::solver
