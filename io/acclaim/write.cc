// FormatAmc and FormatAsf of io/acclaim/acclaim.h.
#include <fmt/format.h>

#include <cassert>

#include "io/acclaim/acclaim.h"
#include "io/acclaim/fit.h"
#include "io/acclaim/skeleton.h"
#include "io/text/cursor.h"

namespace retarget::io {
namespace {

// As many digits as the value needs, at most `digits` behind the point.
void AppendNumber(double value, int digits, std::string* out) {
  std::string text = fmt::format("{:.{}f}", value, digits);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  *out += text == "-0" ? "0" : text;
}

void AppendFrame(const AcclaimFile& file, const acclaim::BoneValues& values, std::string* out) {
  for (const int j : file.amc_order) {
    const AcclaimBone& bone = file.bones[static_cast<size_t>(j)];
    *out += file.motion.rig.joints[static_cast<size_t>(j)].name;
    int next_angle = acclaim::NumTurns(bone);  // of the angles, the outermost comes last
    for (const int kind : bone.dofs) {
      *out += ' ';
      if (kind < kFirstRotationDof) {
        AppendNumber(values.shift[static_cast<size_t>(j)][kind], 7, out);
      } else {
        const double angle = values.angles[static_cast<size_t>(j)][--next_angle];
        AppendNumber(file.degrees ? angle / kDegree : angle, file.degrees ? 7 : 9, out);
      }
    }
    *out += file.crlf ? "\r\n" : "\n";
  }
}

}  // namespace

std::string FormatAmc(const AcclaimFile& original, const RigMotion& motion, double scale) {
  assert(motion.rig.joints.size() == original.bones.size());
  std::string out = original.amc_header;
  acclaim::BoneValues values;
  values.angles.assign(original.bones.size(), Vec3::Zero());
  double number = original.first_frame;
  for (const RigFrame& frame : motion.frames) {
    out += fmt::format("{:.0f}{}", number, original.crlf ? "\r\n" : "\n");
    values = acclaim::FitFrame(original, frame, scale, values);
    AppendFrame(original, values, &out);
    number += 1;
  }
  return out;
}

std::string FormatAsf(const AcclaimFile& original, double scale) {
  if (scale == 1.0) return original.asf_text;
  const std::string& text = original.asf_text;
  std::string out;
  size_t at = 0;
  for (const auto& [begin, end] : acclaim::ReadSkeleton(text, "skeleton").length_numbers) {
    double value = 0;
    bvh::ParseNumber(std::string_view(text).substr(begin, end - begin), &value);
    out += text.substr(at, begin - at);
    AppendNumber(value * scale, 7, &out);
    at = end;
  }
  return out + text.substr(at);
}

}  // namespace retarget::io
