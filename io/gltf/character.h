// Which skins of a glTF document are one character's. Inner part of io/gltf/clip.h.
#pragma once

#include <string>
#include <vector>

#include "io/gltf/load.h"

namespace retarget::io {

// The skins of one character: the selected skin's, or those of the only one. Empty where the file
// has no skin. `humanoid` are nodes known to be a human's: they choose where nothing is selected.
// Throws InputError that lists the characters where there is a choice.
std::vector<int> CharacterSkins(const LoadedGltf& gltf, const std::string& select,
                                const std::vector<int>& humanoid, const std::string& name);

}  // namespace retarget::io
