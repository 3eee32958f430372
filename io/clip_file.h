// A motion file of any format that the project reads, and the solved motion back in the same
// format. Formats are told by content, not by the file's name.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "io/acclaim/acclaim.h"
#include "io/bvh/bvh.h"
#include "io/gltf/clip.h"
#include "io/named_bytes.h"
#include "io/playback/playback.h"

namespace retarget::io {

// Where a clip is: a path, with what some formats need beside it:
//   walk.bvh
//   hero.glb#animation=Walk,skin=1     (names, or indices from 0; either may be left out)
//   pair.bvh#figure=1                  (of several people, of any format: a name or an index)
//   skeleton.asf:walk.amc
// A file that is called just so is that file.
struct ClipPath {
  std::string path;      // of the motion
  std::string skeleton;  // of an Acclaim motion
  GltfSelect select;     // of other formats the figure alone
};
ClipPath ParseClipPath(const std::string& text);  // throws InputError
// The same of files in memory: what stands before '#', or on either side of ':', is only a name.
ClipPath ParseClipName(const std::string& text, bool with_skeleton);

struct ClipFile {
  RigMotion motion;
  std::variant<BvhFile, GltfClip, AcclaimFile> original;
  std::string format;                     // "BVH", "glTF", "Acclaim"
  std::optional<double> metres_per_unit;  // as the format says it
  std::optional<char> up;
  std::optional<JointMap> map;  // as the file says it (VRM)
  GltfSelect select;
  // Of a file of several people of whom none was selected, `motion` being of all: the joints of the
  // first with what carries them, and the names of all. Else empty.
  std::vector<int> figure_joints;
  std::vector<std::string> figures;
  bool has_motion = true;  // false: a character at rest
  std::vector<std::string> notes;
  std::string bytes;  // of all files read, for hashing
};

// `fps`: of an Acclaim motion, which does not say. Throws InputError.
ClipFile ReadClipFile(const ClipPath& path, double fps = kAcclaimFps);
ClipFile ReadClipFile(const std::string& text);
// The same from bytes; `skeleton` is that of an Acclaim motion, else empty. Buffers that a .gltf
// names are looked for beside `path`.
ClipFile ParseClipFile(const ClipPath& path, std::string bytes, const std::string& skeleton,
                       double fps = kAcclaimFps);

// Files that hold `motion` in the format of `original`, the first of them the motion itself; names
// begin with `stem`: a.bvh, a.glb, a.gltf with the files it refers to, a.vrm, a.vrma, a.amc with
// its a.asf. `stature_ratio` is that of the body the motion is for, over the file's own.
std::vector<NamedBytes> FormatClipFile(const ClipFile& original, const RigMotion& motion,
                                       const std::string& stem, double stature_ratio);
// The names alone.
std::vector<std::string> NamesOfClipFile(const ClipFile& original, const std::string& stem);

// A glTF clip and its motion for a body of another size: glTF has no lengths to scale, so the roots
// get a scale, and the translations below them are as they would be without.
struct ScaledGltf {
  GltfClip clip;
  RigMotion motion;
};
ScaledGltf ScaleGltf(const GltfClip& original, const RigMotion& motion, double ratio);

// The same files to be played by io/playback/playback.h, and a joint of the clip's rig in them.
PlayedFile PlayedFileOf(const ClipFile& original, const std::vector<NamedBytes>& files);
PlayedJoint JointInFile(const ClipFile& original, int joint);

// Name of the animation that is added to a glTF file.
inline constexpr const char* kAnimationName = "retargeted";

}  // namespace retarget::io
