// The valid name that a misspelt one was probably meant to be.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace retarget::io {

// Fewest insertions, deletions, replacements and exchanges of neighbours that turn `a` into `b`
// (optimal string alignment); upper and lower case are equal. Reads the first 64 characters of
// each.
size_t EditDistance(std::string_view a, std::string_view b);

// The name with the smallest edit distance, the first of equals. `names` must not be empty.
const std::string& NearestName(std::string_view word, const std::vector<std::string>& names);

// The end of a message about an unknown word: `, did you mean "prefix.name"?`, or, where nothing
// comes near and the list is short, `, expected one of a, b, c`. `prefix` is put before the name.
std::string Suggestion(std::string_view word, const std::vector<std::string>& names,
                       const std::string& prefix = "");

}  // namespace retarget::io
