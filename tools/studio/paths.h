// Where the studio's files lie, and what keeps it in its folders: no "..", no links out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace retarget::studio {

// Folder of the shipped data: $RETARGET_DATA_DIR, else share/retarget beside the program's bin,
// else where the program was built from.
std::filesystem::path ShippedDataFolder();

// Of the user's own templates: in $XDG_DATA_HOME, else in ~/.local/share. May not be there yet.
std::filesystem::path UserTemplateFolder();

// The id that a name for a file gives: "choke" of "choke.yaml". Throws InputError where it would
// not stay in its folder, or not be a plain name.
std::string CheckedId(const std::string& name);

// Whether a name is that of a file in the same folder.
bool IsPlainName(const std::string& name);

// Whether a path leads, links followed, to something, or a file, in a folder.
bool IsWithin(const std::filesystem::path& path, const std::filesystem::path& folder);
bool IsFileWithin(const std::filesystem::path& path, const std::filesystem::path& folder);

// The bytes of a file; throws InputError where it has more than `most`.
std::string ReadAtMost(const std::filesystem::path& path, uintmax_t most);

// Where a template's pictures lie.
std::vector<std::filesystem::path> PhotosOf(const std::filesystem::path& path);
std::filesystem::path ThumbnailOf(const std::filesystem::path& path);

}  // namespace retarget::studio
