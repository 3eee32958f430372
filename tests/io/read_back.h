// What is written, read again as any reader would.
#pragma once

#include "io/clip_file.h"

namespace retarget::io {

// The motion that the files of FormatClipFile hold.
inline RigMotion ReadBack(const ClipFile& original, const std::vector<NamedBytes>& files) {
  const NamedBytes& first = files[0];
  if (const auto* gltf = std::get_if<GltfClip>(&original.original)) {
    ClipPath path;
    path.path = (gltf->folder.empty() ? "" : gltf->folder + "/") + first.name;
    path.select = {.animation = kAnimationName,
                   .skin = original.select.skin,
                   .figure = original.select.figure};
    return ParseClipFile(path, first.bytes, "").motion;
  }
  if (original.format == "Acclaim") {
    return ParseAcclaim(files[1].bytes, files[1].name, first.bytes, first.name,
                        1 / original.motion.frame_time)
        .motion;
  }
  return ParseBvh(first.bytes, first.name).motion;
}

}  // namespace retarget::io
