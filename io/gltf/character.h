// Which skins of a glTF document are one character's. Inner part of io/gltf/clip.h.
#pragma once

#include <string>
#include <vector>

#include "io/gltf/clip.h"
#include "io/gltf/load.h"

namespace retarget::io {

// The skins of one character: the selected skin's or figure's, or those of the only one. Empty
// where the file has no skin. A figure among several characters has the names of its skins and of
// their topmost joints; with one character a figure is left to others to find. `humanoid` are nodes
// known to be a human's: they choose where nothing is selected. Throws InputError that lists the
// characters where there is a choice.
std::vector<int> CharacterSkins(const LoadedGltf& gltf, const GltfSelect& select,
                                const std::vector<int>& humanoid, const std::string& name);

}  // namespace retarget::io
