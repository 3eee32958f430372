// What is in a motion or character file, without asking whether it is a human's.
#pragma once

#include <string>
#include <vector>

namespace retarget::io {

struct NamedFact {
  std::string name, value;
};

// Facts in the order to show them: format, animations, characters, joints, frames, rate, notes.
// `text` as ParseClipPath takes it. Throws InputError where the file cannot be read.
std::vector<NamedFact> InspectClip(const std::string& text);

}  // namespace retarget::io
