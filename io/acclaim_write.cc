// FormatAmc and FormatAsf of io/acclaim.h.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "io/acclaim.h"
#include "io/acclaim_skeleton.h"
#include "io/bvh_text.h"
#include "io/euler_angles.h"

namespace retarget {
namespace {

// As many digits as the value needs, at most `digits` behind the point.
void AppendNumber(double value, int digits, std::string* out) {
  std::string text = fmt::format("{:.{}f}", value, digits);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  *out += text == "-0" ? "0" : text;
}

int NumTurns(const AcclaimBone& bone) {
  return static_cast<int>(
      std::ranges::count_if(bone.dofs, [](int kind) { return kind >= kFirstRotationDof; }));
}

// The axes of a bone's turns, the outermost (last) turn first, filled up to three.
std::array<int, 3> TurnAxes(const AcclaimBone& bone) {
  std::vector<int> axes;
  for (size_t k = bone.dofs.size(); k-- > 0;) {
    if (bone.dofs[k] >= kFirstRotationDof) axes.push_back(bone.dofs[k] - kFirstRotationDof);
  }
  return CompleteAxes(axes);
}

// Turns `angles` (rad) of the first `count` axes so that their product, the others at rest, comes
// as near to `wanted` as it can: one angle at a time, each the best for what the others leave.
void FitAngles(const Quat& wanted, const std::array<int, 3>& axes, int count, Vec3* angles) {
  constexpr int kRounds = 20;
  for (int round = 0; round < (count == 1 ? 1 : kRounds); ++round) {
    for (int n = 0; n < count; ++n) {
      Quat before = Quat::Identity(), after = Quat::Identity();
      for (int k = 0; k < count; ++k) {
        if (k < n) before = before * AxisTurn(axes[static_cast<size_t>(k)], (*angles)[k]);
        if (k > n) after = after * AxisTurn(axes[static_cast<size_t>(k)], (*angles)[k]);
      }
      const Quat left = before.conjugate() * wanted * after.conjugate();
      const double along = left.vec()[axes[static_cast<size_t>(n)]];
      if (std::hypot(along, left.w()) < 1e-9) continue;  // every angle is as good
      (*angles)[n] = 2 * std::atan2(along, left.w());
    }
  }
}

// Writes frames; keeps each bone's angles of the frame before.
class FrameWriter {
 public:
  FrameWriter(const AcclaimFile& original, const Rig& rig, double scale)
      : original_(original),
        rig_(rig),
        scale_(scale),
        angles_(original.bones.size(), Vec3::Zero()),
        shift_(original.bones.size()),
        lost_(original.bones.size()) {}

  void Append(const RigFrame& frame, std::string* out) {
    for (size_t j = 0; j < angles_.size(); ++j) FitBone(frame, j);
    for (const int j : original_.amc_order) {
      const AcclaimBone& bone = original_.bones[static_cast<size_t>(j)];
      *out += rig_.joints[static_cast<size_t>(j)].name;
      int next_angle = NumTurns(bone);
      for (const int kind : bone.dofs) {
        *out += ' ';
        if (kind < kFirstRotationDof) {
          AppendNumber(shift_[static_cast<size_t>(j)][kind], 7, out);
        } else {  // of the angles, the outermost comes last
          const double angle = angles_[static_cast<size_t>(j)][--next_angle];
          AppendNumber(original_.degrees ? angle / kDegree : angle, original_.degrees ? 7 : 9, out);
        }
      }
      *out += original_.crlf ? "\r\n" : "\n";
    }
  }

 private:
  // Values of bone j in the frame, and what they lose: with W the rotation in the world as wanted
  // and A as the file can hold it, A = W lost.
  void FitBone(const RigFrame& frame, size_t j) {
    const AcclaimBone& bone = original_.bones[j];
    const int parent = rig_.joints[j].parent;
    const Quat lost_above =
        parent < 0 ? Quat::Identity() : lost_[static_cast<size_t>(parent)].conjugate();
    const Quat wanted = (lost_above * frame.rotation[j]).normalized();
    const std::array<int, 3> axes = TurnAxes(bone);
    const Quat turn = bone.axes.conjugate() * wanted * bone.axes;
    const int num_angles = NumTurns(bone);
    const Vec3 before = angles_[j];
    angles_[j] = EulerAngles(turn.normalized().toRotationMatrix(), axes, before);
    if (num_angles < 3) FitAngles(turn, axes, num_angles, &angles_[j]);
    Quat held = Quat::Identity();
    for (int k = 0; k < num_angles; ++k) {
      angles_[j][k] += 2 * kPi * std::round((before[k] - angles_[j][k]) / (2 * kPi));
      held = held * AxisTurn(axes[static_cast<size_t>(k)], angles_[j][k]);
    }
    for (int k = num_angles; k < 3; ++k) angles_[j][k] = 0;  // these axes do not turn
    lost_[j] = (wanted.conjugate() * bone.axes * held * bone.axes.conjugate()).normalized();
    const Vec3 shift = frame.translation[j] - scale_ * original_.motion.rig.joints[j].offset;
    shift_[j] = j > 0 ? bone.axes.conjugate() * shift : shift;
  }

  const AcclaimFile& original_;
  const Rig& rig_;
  double scale_;
  std::vector<Vec3> angles_;  // rad, in the order of TurnAxes
  std::vector<Vec3> shift_;
  std::vector<Quat> lost_;
};

}  // namespace

std::string FormatAmc(const AcclaimFile& original, const RigMotion& motion, double scale) {
  assert(motion.rig.joints.size() == original.bones.size());
  std::string out = original.amc_header;
  FrameWriter writer(original, original.motion.rig, scale);
  double number = original.first_frame;
  for (const RigFrame& frame : motion.frames) {
    out += fmt::format("{:.0f}{}", number, original.crlf ? "\r\n" : "\n");
    writer.Append(frame, &out);
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

}  // namespace retarget
