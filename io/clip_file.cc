#include "io/clip_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "io/recognition/figures.h"
#include "io/text/quoted.h"
#include "io/text/read_file.h"
#include "model/rig/tree.h"

namespace retarget::io {
namespace {

namespace fs = std::filesystem;

constexpr double kInch = 0.0254;         // m
constexpr double kCmuLengthUnit = 0.45;  // `:units length` of CMU: of an inch

bool IsFile(const std::string& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

enum class Format { kBvh, kGltf, kAsf, kAmc, kUnknown };

// By the first word that is no comment.
Format FormatOf(const std::string& bytes) {
  if (bytes.rfind("glTF", 0) == 0) return Format::kGltf;
  std::istringstream lines(bytes.substr(0, 65536));
  std::string line;
  while (std::getline(lines, line)) {
    size_t at = 0;
    if (line.rfind("\xEF\xBB\xBF", 0) == 0) at = 3;
    at = line.find_first_not_of(" \t\r", at);
    if (at == std::string::npos || line[at] == '#') continue;
    if (line[at] == '{') return Format::kGltf;
    std::string word;
    while (at < line.size() && !std::isspace(static_cast<unsigned char>(line[at]))) {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(line[at++])));
    }
    if (word == "hierarchy") return Format::kBvh;
    if (word == ":fully-specified" || word == ":degrees" || word == ":radians") return Format::kAmc;
    if (word[0] == ':') return Format::kAsf;
    if (!word.empty() && std::isdigit(static_cast<unsigned char>(word[0]))) return Format::kAmc;
    return Format::kUnknown;
  }
  return Format::kUnknown;
}

ClipFile FromBvh(std::string bytes, const std::string& path) {
  ClipFile clip;
  BvhFile file = ParseBvh(bytes, path);
  clip.format = "BVH";
  clip.motion = file.motion;
  clip.notes = file.warnings;
  clip.original = std::move(file);
  clip.bytes = std::move(bytes);
  return clip;
}

// An animation may go without a name.
bool HasAnimation(const GltfClip& clip) {
  return !clip.animation.empty() || clip.motion.num_frames() > 1 || !clip.key_times.empty();
}

ClipFile FromGltf(std::string bytes, const ClipPath& path) {
  ClipFile clip;
  clip.bytes = bytes;
  GltfClip file = ParseGltf(
      std::move(bytes), path.path,
      fs::path(path.path).parent_path().empty() ? "." : fs::path(path.path).parent_path().string(),
      path.select);
  clip.format = "glTF";
  clip.motion = file.motion;
  clip.notes = file.notes;
  clip.metres_per_unit = 1;
  clip.up = 'y';
  clip.map = file.map;
  clip.has_motion = !path.select.at_rest && HasAnimation(file);
  clip.original = std::move(file);
  return clip;
}

ClipFile FromAcclaim(const std::string& asf, const std::string& amc, const ClipPath& path,
                     double fps) {
  ClipFile clip;
  AcclaimFile file = ParseAcclaim(asf, path.skeleton, amc, path.path, fps);
  clip.format = "Acclaim";
  clip.motion = file.motion;
  clip.notes = file.warnings;
  if (std::abs(file.length_unit - kCmuLengthUnit) < 1e-9) {
    clip.metres_per_unit = kInch / kCmuLengthUnit;
  }
  clip.original = std::move(file);
  clip.bytes = asf + amc;
  return clip;
}

void ParseSelection(const std::string& text, const std::string& selection, GltfSelect* select) {
  std::istringstream parts(selection);
  std::string part;
  while (std::getline(parts, part, ',')) {
    const size_t equals = part.find('=');
    const std::string key = part.substr(0, equals);
    std::string* value = key == "animation" ? &select->animation
                         : key == "skin"    ? &select->skin
                         : key == "figure"  ? &select->figure
                                            : nullptr;
    if (equals == std::string::npos || value == nullptr) {
      throw InputError(
          text + ": expected #animation=NAME,skin=NAME,figure=NAME after the file, found " + part);
    }
    *value = part.substr(equals + 1);
  }
}

void CutTo(const std::vector<int>& joints, ClipFile* clip) {
  if (auto* bvh = std::get_if<BvhFile>(&clip->original)) {
    *bvh = CutBvh(*bvh, joints);
    clip->motion = bvh->motion;
  } else if (auto* gltf = std::get_if<GltfClip>(&clip->original)) {
    *gltf = CutGltf(*gltf, joints);
    clip->motion = gltf->motion;
  }
}

// Leaves the selected figure, or finds out whether there is a choice.
void ChooseFigure(const ClipPath& path, ClipFile* clip) {
  clip->select = path.select;
  const std::string& wanted = path.select.figure;
  const auto* gltf = std::get_if<GltfClip>(&clip->original);
  if (wanted.empty()) {
    if (clip->map) return;  // the file says who is meant
    const std::vector<FileFigure> figures = FindFigures(clip->motion);
    if (figures.size() < 2) return;
    for (const FileFigure& figure : figures) clip->figures.push_back(figure.name);
    clip->figure_joints = BranchOf(clip->motion.rig, figures[0].joint);
    return;
  }
  // Of several skinned characters it was told by its skins, and the only one is the first.
  if (gltf != nullptr && gltf->is_one_of_several) return;
  const FileFigure figure = SelectFigure(clip->motion, wanted, path.path);
  const std::vector<int> joints = BranchOf(clip->motion.rig, figure.joint);
  clip->select.figure = figure.name;  // in what is written, it may be another number
  if (joints.size() == clip->motion.rig.joints.size()) return;
  clip->notes.push_back(
      "the figure " + Quoted(figure.name) +
      " is read alone: what is written on its rig does not hold the others' motion");
  CutTo(joints, clip);
}

ClipFile ParseFormat(const ClipPath& path, std::string bytes, const std::string& skeleton,
                     double fps) {
  const Format format = FormatOf(bytes);
  const bool selected = !path.select.animation.empty() || !path.select.skin.empty();
  if (selected && format != Format::kGltf) {
    throw InputError(path.path +
                     ": is no glTF file, so #animation and #skin mean nothing; one of several "
                     "people is selected with #figure=NAME");
  }
  if (!path.skeleton.empty()) {
    if (FormatOf(skeleton) != Format::kAsf) {
      throw InputError(path.skeleton + ": expected an Acclaim skeleton (ASF) before the ':'");
    }
    return FromAcclaim(skeleton, bytes, path, fps);
  }
  switch (format) {
    case Format::kBvh:
      return FromBvh(std::move(bytes), path.path);
    case Format::kGltf:
      return FromGltf(std::move(bytes), path);
    case Format::kAsf:
      throw InputError(path.path + ": is an Acclaim skeleton; name its motion too: " + path.path +
                       ":CLIP.amc");
    case Format::kAmc:
      throw InputError(path.path +
                       ": is an Acclaim motion; name its skeleton too: SKELETON.asf:" + path.path);
    case Format::kUnknown:
      break;
  }
  // The reader of the likeliest format says what is wrong.
  const std::string extension = fs::path(path.path).extension().string();
  if (extension == ".glb" || extension == ".gltf" || extension == ".vrm" || extension == ".vrma") {
    return FromGltf(std::move(bytes), path);
  }
  return FromBvh(std::move(bytes), path.path);
}

}  // namespace

ClipPath ParseClipPath(const std::string& text) {
  ClipPath out;
  out.path = text;
  if (IsFile(text)) return out;
  const size_t hash = text.rfind('#');
  if (hash != std::string::npos && IsFile(text.substr(0, hash))) {
    out.path = text.substr(0, hash);
    ParseSelection(text, text.substr(hash + 1), &out.select);
    return out;
  }
  // The colon that parts two files; a drive letter's does not.
  for (size_t colon = text.find(':'); colon != std::string::npos;
       colon = text.find(':', colon + 1)) {
    if (!IsFile(text.substr(0, colon))) continue;
    out.skeleton = text.substr(0, colon);
    out.path = text.substr(colon + 1);
    return out;
  }
  return out;
}

ClipPath ParseClipName(const std::string& text, bool with_skeleton) {
  ClipPath out;
  out.path = text;
  const size_t mark = text.rfind(with_skeleton ? ':' : '#');
  if (mark == std::string::npos) {
    if (with_skeleton) out.skeleton = "skeleton of " + text;
    return out;
  }
  if (with_skeleton) {
    out.skeleton = text.substr(0, mark);
    out.path = text.substr(mark + 1);
  } else {
    out.path = text.substr(0, mark);
    ParseSelection(text, text.substr(mark + 1), &out.select);
  }
  return out;
}

ClipFile ReadClipFile(const ClipPath& path, double fps) {
  std::string bytes = ReadFile(path.path);
  return ParseClipFile(path, std::move(bytes),
                       path.skeleton.empty() ? std::string() : ReadFile(path.skeleton), fps);
}

ClipFile ParseClipFile(const ClipPath& path, std::string bytes, const std::string& skeleton,
                       double fps) {
  ClipFile clip = ParseFormat(path, std::move(bytes), skeleton, fps);
  ChooseFigure(path, &clip);
  return clip;
}

ClipFile ReadClipFile(const std::string& text) { return ReadClipFile(ParseClipPath(text)); }

}  // namespace retarget::io
