// Solves a scene from one start after the other, until what comes out is sound.
//
// A solve that converges may still show what no step can mend: a limb on the wrong side, where it
// came to lie while contacts were weak, or a limb that goes through a limb from one frame to the
// next. The clip is then solved again, as far as each of these applies:
//   - frames beyond a pass-through are solved again from the side of the template's, and the clip
//     is made even (CurePassThroughs);
//   - from the same start with full contacts, where a requirement is missed;
//   - from the same start with free feet guided more softly, where only those miss;
//   - from the other start, and from the simulated motion as it is, where the result is worse than
//     that motion, the baseline: more pass-throughs, a tag lost that it keeps, or deeper.
// The best is kept, and what was done is said in the warnings.
#pragma once

#include "solver/retarget.h"

namespace retarget::solver {

// Fills the members start, start_seconds, solve and warnings of `result`, whose scene is that of
// the problem and whose simulation is done. With a time limit (solve.max_seconds) there is one
// attempt.
void SolveInAttempts(const Problem& problem, const Progress& progress, RetargetResult* result);

}  // namespace retarget::solver
