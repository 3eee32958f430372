// Reading the motion; acclaim_skeleton.cc reads the skeleton, acclaim_write.cc writes.
#include "io/acclaim/acclaim.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/acclaim/skeleton.h"
#include "io/acclaim/text.h"
#include "io/text/cursor.h"
#include "io/text/nearest_name.h"
#include "io/text/quoted.h"
#include "io/text/read_file.h"
#include "model/geometry/euler_angles.h"

namespace retarget::io {
namespace {

using acclaim::LineReader;
using acclaim::Skeleton;
using bvh::SameWord;

// A bound that no real file reaches, so that a damaged one cannot ask for all memory.
constexpr size_t kMaxJointFrames = 20'000'000;

class MotionReader {
 public:
  MotionReader(std::string_view text, const std::string& name, const Skeleton& skeleton)
      : lines_(text, name), skeleton_(skeleton) {
    for (const AcclaimBone& bone : skeleton_.bones) values_.emplace_back(bone.dofs.size(), 0.0);
    seen_in_.assign(values_.size(), -1);
    file_.degrees = skeleton_.degrees;
  }

  // All of the file but the rig, the bones and the texts.
  AcclaimFile Read() {
    bool more = lines_.Next();
    for (; more && lines_.key().starts_with(':'); more = lines_.Next()) ReadKeyword();
    header_end_ = lines_.line_begin();
    while (more) {
      ReadFrameNumber();
      while ((more = lines_.Next()) && !IsFrameNumber()) ReadBone();
      EndFrame();
    }
    if (num_frames_ == 0) lines_.Fail("no frames", "a frame number");
    ListBones();
    return std::move(file_);
  }

  size_t header_end() const { return header_end_; }

 private:
  void ReadKeyword() {
    if (SameWord(lines_.key(), ":degrees")) file_.degrees = true;
    if (SameWord(lines_.key(), ":radians")) file_.degrees = false;
  }

  bool IsFrameNumber() const {
    double unused = 0;
    return lines_.words().size() == 1 &&
           bvh::ParseNumber(lines_.key(), &unused) != bvh::NumberFault::kNotANumber;
  }

  void ReadFrameNumber() {
    const double number = lines_.Number(0, "a frame number");
    if (lines_.words().size() != 1 || number != std::floor(number)) {
      lines_.FailAtWord(lines_.key(), "a frame number alone on its line");
    }
    if (num_frames_ == 0) {
      file_.first_frame = number;
    } else if (number <= number_) {
      lines_.Fail(fmt::format("frame {:.0f} after frame {:.0f}", number, number_),
                  "numbers that rise");
    } else if (number > number_ + 1 && num_gaps_++ == 0) {
      file_.warnings.push_back(fmt::format(
          "no frames between {:.0f} and {:.0f}: those there are play one after the other", number_,
          number));
    }
    number_ = number;
  }

  void ReadBone() {
    const auto it = skeleton_.joint_of_name.find(acclaim::LowerCase(lines_.key()));
    if (it == skeleton_.joint_of_name.end()) {
      std::vector<std::string> names;
      for (const RigJoint& joint : skeleton_.rig.joints) names.push_back(Printable(joint.name));
      lines_.FailAtWord(lines_.key(), "a bone of the skeleton" + Suggestion(lines_.key(), names));
    }
    const size_t joint = static_cast<size_t>(it->second);
    std::vector<double>& values = values_[joint];
    if (lines_.words().size() != values.size() + 1) {
      lines_.Fail(fmt::format("{} numbers", lines_.words().size() - 1),
                  fmt::format("{}, one per degree of freedom of {}", values.size(),
                              QuotedWord(lines_.key())));
    }
    if (seen_in_[joint] == num_frames_) {
      lines_.FailAtWord(lines_.key(), "each bone once per frame");
    }
    if (seen_in_[joint] < 0 && !values.empty()) file_.amc_order.push_back(it->second);
    seen_in_[joint] = num_frames_;
    for (size_t k = 0; k < values.size(); ++k) values[k] = lines_.Number(k + 1, "a number");
  }

  void EndFrame() {
    const size_t joints = values_.size();
    if ((static_cast<size_t>(num_frames_) + 1) * joints > kMaxJointFrames) {
      lines_.Fail("too many frames", fmt::format("at most {} bones times frames", kMaxJointFrames));
    }
    if (std::ranges::find(seen_in_, num_frames_) == seen_in_.end()) {
      lines_.Fail(fmt::format("a frame {:.0f} without bones", number_), "at least one");
    }
    RigFrame frame;
    for (size_t j = 0; j < joints; ++j) AddJoint(j, &frame);
    file_.motion.frames.push_back(std::move(frame));
    ++num_frames_;
  }

  void AddJoint(size_t j, RigFrame* frame) {
    const AcclaimBone& bone = skeleton_.bones[j];
    Vec3 shift = Vec3::Zero();
    Quat turn = Quat::Identity();
    for (size_t k = 0; k < bone.dofs.size(); ++k) {
      const int axis = bone.dofs[k] % kFirstRotationDof;
      const double value = values_[j][k];
      if (bone.dofs[k] < kFirstRotationDof) {
        shift[axis] = value;
      } else {
        turn = AxisTurn(axis, value * (file_.degrees ? kDegree : 1)) * turn;
      }
    }
    if (j > 0) shift = bone.axes * shift;  // the root moves along the world's axes
    frame->translation.push_back(skeleton_.rig.joints[j].offset + shift);
    frame->rotation.push_back(bone.axes * turn * bone.axes.conjugate());
    if (!bone.dofs.empty() && seen_in_[j] >= 0 && seen_in_[j] < num_frames_ &&
        num_left_out_++ == 0) {
      file_.warnings.push_back(fmt::format("frame {:.0f} leaves out {}: it stays as it was",
                                           number_, QuotedWord(skeleton_.rig.joints[j].name)));
    }
  }

  // Bones that no frame names follow those of the file.
  void ListBones() {
    for (size_t j = 0; j < values_.size(); ++j) {
      if (seen_in_[j] >= 0 || values_[j].empty()) continue;
      file_.warnings.push_back("no frame names " + QuotedWord(skeleton_.rig.joints[j].name) +
                               ": it stays at rest");
      file_.amc_order.push_back(static_cast<int>(j));
    }
    if (num_gaps_ > 1) file_.warnings.push_back(fmt::format("{} gaps between frames", num_gaps_));
    if (num_left_out_ > 1) {
      file_.warnings.push_back(fmt::format("bones are left out {} times", num_left_out_));
    }
  }

  LineReader lines_;
  const Skeleton& skeleton_;
  AcclaimFile file_;
  std::vector<std::vector<double>> values_;  // per joint, of the present frame
  std::vector<int> seen_in_;                 // per joint: the last frame that names it, or -1
  double number_ = 0;
  int num_frames_ = 0, num_gaps_ = 0, num_left_out_ = 0;
  size_t header_end_ = 0;
};

}  // namespace

AcclaimFile ParseAcclaim(std::string_view asf_text, const std::string& asf_name,
                         std::string_view amc_text, const std::string& amc_name, double fps) {
  if (!std::isfinite(fps) || fps <= 0) {
    throw InputError(amc_name + ": the frame rate must be a positive number of frames per second");
  }
  Skeleton skeleton = acclaim::ReadSkeleton(asf_text, asf_name);
  MotionReader reader(amc_text, amc_name, skeleton);
  AcclaimFile file = reader.Read();
  file.motion.rig = std::move(skeleton.rig);
  file.motion.frame_time = 1 / fps;
  file.bones = std::move(skeleton.bones);
  file.length_unit = skeleton.length_unit;
  file.asf_text = std::string(asf_text);
  file.amc_header = std::string(amc_text.substr(0, reader.header_end()));
  const size_t first_end = amc_text.find('\n');
  file.crlf =
      first_end != std::string_view::npos && first_end > 0 && amc_text[first_end - 1] == '\r';
  file.warnings.push_back(
      fmt::format("Acclaim files name no frame rate: played at {:g} per second", fps));
  return file;
}

AcclaimFile ReadAcclaim(const std::string& asf_path, const std::string& amc_path, double fps) {
  return ParseAcclaim(ReadFilledFile(asf_path, "an ASF file"), asf_path,
                      ReadFilledFile(amc_path, "an AMC file"), amc_path, fps);
}

}  // namespace retarget::io
