// A posture out of one frame of each of two clips.
#pragma once

#include <array>

#include "io/load_clip.h"
#include "model/body/template_posture.h"

namespace retarget::api {

// As captured, which is a posture of two where the clips share a world; `together` false: each
// turned towards the other, 1 m apart. Frames count from 0. Throws InputError.
TemplatePosture PostureOfFrames(const std::array<const io::LoadedClip*, 2>& clip,
                                const std::array<int, 2>& frame, bool together);

}  // namespace retarget::api
