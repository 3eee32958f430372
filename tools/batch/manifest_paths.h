// Files that a manifest names.
#pragma once

#include <string>

namespace retarget::batch {

// Whether the column names a file: it is looked for beside the manifest.
bool IsPathColumn(const std::string& column);
// Whether commas in a text of the column are its own: it is no sweep.
bool IsWholeColumn(const std::string& column);

// The path (of a clip with what stands after '#', or of skeleton:motion) as it can be opened from
// the current folder: beside the manifest, in `folder`, or else as it stands. Throws InputError
// where it could be either of two files.
std::string PathFrom(const std::string& folder, const std::string& text);

}  // namespace retarget::batch
