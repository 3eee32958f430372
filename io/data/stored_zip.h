// A zip archive of files that are stored as they are (PKWARE APPNOTE 6.3.3, method 0), for readers
// that expect one, such as numpy's of .npz. No times: equal files give equal bytes.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace retarget::io {

// `files`: names and bytes. Throws InputError where a file, or all of them, exceed the 4 GB that
// the format has room for.
std::string FormatStoredZip(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace retarget::io
