// What is put right in a captured motion before anything reads it, and said in the clip's notes.
#pragma once

#include "io/load_clip.h"

namespace retarget::io {

// Notes frames that cannot be true, or repairs them as asked for (ClipOptions::repair_jumps).
void TreatJumps(LoadedClip* clip);

// Gives a bound clip that strides in place its way over the floor, unless it is to stay there
// (ClipOptions::keep_in_place).
void RecoverTravel(LoadedClip* clip);

}  // namespace retarget::io
