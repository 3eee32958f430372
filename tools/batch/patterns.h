// A manifest out of two patterns of files.
#pragma once

#include <string>
#include <vector>

namespace retarget::batch {

enum class Pairing {
  kAll,   // every clip of the first kind with every one of the second
  kName,  // those whose files are called the same
};

// A manifest (CSV) of the files that two patterns of a shell name, and of the templates. Throws
// InputError where a pattern names nothing.
std::string ManifestOfPatterns(const std::string& clips_a, const std::string& clips_b,
                               const std::vector<std::string>& templates, Pairing pairing);

}  // namespace retarget::batch
