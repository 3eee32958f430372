#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "io/playback/players.h"

namespace retarget::io::playback {
namespace {

struct Bone {
  int parent = -1;
  Vec3 offset = Vec3::Zero();
  std::vector<std::string> channels;  // lower case: "xposition", "zrotation", ...
};

std::string Lower(std::string word) {
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

class BvhPlayer {
 public:
  explicit BvhPlayer(const PlayedFile& file) : file_(file) {
    size_t at = ReadHierarchy();
    ReadMotion(at);
  }

  Played Play(const std::vector<PlayedJoint>& joints, const std::vector<double>& times) const {
    std::vector<int> parent;
    for (const Bone& bone : bones_) parent.push_back(bone.parent);
    return PlayFrames(parent, frames_, frame_time_, IndicesOf(joints, names_, file_.name), times);
  }

 private:
  // The next word from `at`, which is left behind it; braces are words of their own.
  std::string Word(size_t* at) const {
    const std::string& text = file_.bytes;
    const auto is_space = [&](size_t i) {
      return std::isspace(static_cast<unsigned char>(text[i]));
    };
    while (*at < text.size() && is_space(*at)) ++*at;
    const size_t begin = *at;
    while (*at < text.size() && !is_space(*at)) {
      const bool brace = text[*at] == '{' || text[*at] == '}';
      if (brace && *at > begin) break;
      ++*at;
      if (brace) break;
    }
    return text.substr(begin, *at - begin);
  }

  // Names may hold blanks: all up to the brace or the end of the line.
  std::string Name(size_t* at) const {
    const std::string& text = file_.bytes;
    const size_t end = std::min(text.find_first_of("{\r\n", *at), text.size());
    std::string name = text.substr(*at, end - *at);
    *at = end;
    const size_t first = name.find_first_not_of(" \t\v\f");
    if (first == std::string::npos) return "";
    return name.substr(first, name.find_last_not_of(" \t\v\f") + 1 - first);
  }

  double Number(size_t* at) const { return std::strtod(Word(at).c_str(), nullptr); }

  // Returns where MOTION ends.
  size_t ReadHierarchy() {
    std::vector<int> open;  // -1: an End Site
    int next = -1;          // what the next brace opens
    for (size_t at = 0; at < file_.bytes.size();) {
      const std::string word = Lower(Word(&at));
      if (word == "motion" && open.empty()) return at;
      if (word == "root" || word == "joint") {
        bones_.push_back({open.empty() ? -1 : open.back(), Vec3::Zero(), {}});
        names_.push_back(Name(&at));
        next = static_cast<int>(bones_.size()) - 1;
      } else if (word == "end") {
        Name(&at);
        next = -1;
      } else if (word == "{") {
        open.push_back(next);
      } else if (word == "}" && !open.empty()) {
        open.pop_back();
      } else if (word == "offset" && !open.empty() && open.back() >= 0) {
        for (int c = 0; c < 3; ++c)
          bones_[static_cast<size_t>(open.back())].offset[c] = Number(&at);
      } else if (word == "channels" && !open.empty() && open.back() >= 0) {
        for (int count = static_cast<int>(Number(&at)); count > 0; --count) {
          bones_[static_cast<size_t>(open.back())].channels.push_back(Lower(Word(&at)));
        }
      }
    }
    throw InputError(file_.name + ": no MOTION after the hierarchy");
  }

  void ReadMotion(size_t at) {
    size_t colon = file_.bytes.find(':', at);
    at = colon == std::string::npos ? file_.bytes.size() : colon + 1;
    const int count = static_cast<int>(Number(&at));
    colon = file_.bytes.find(':', at);
    at = colon == std::string::npos ? file_.bytes.size() : colon + 1;
    frame_time_ = Number(&at);
    // Rates are written with few digits: 0.033333 is thirty per second.
    const double rate = std::round(1 / frame_time_);
    if (std::abs(1 / frame_time_ - rate) < 2e-4 * rate) frame_time_ = 1 / rate;
    for (int f = 0; f < count; ++f) {
      frames_.emplace_back();
      for (int j = 0; j < static_cast<int>(bones_.size()); ++j) {
        const bool displaced = std::ranges::find(file_.displaced, j) != file_.displaced.end();
        frames_.back().push_back(ReadBone(bones_[static_cast<size_t>(j)], displaced, &at));
      }
    }
    const size_t rest = static_cast<size_t>(std::max(file_.rest_frames, 0));
    if (frames_.size() <= rest || !(frame_time_ > 0)) throw InputError(file_.name + ": no frames");
    frames_.erase(frames_.begin(), frames_.begin() + static_cast<long>(rest));
  }

  LocalTransform ReadBone(const Bone& bone, bool displaced, size_t* at) const {
    LocalTransform out;
    out.translation = bone.offset;
    for (const std::string& channel : bone.channels) {
      const int axis = channel[0] - 'x';
      const double value = Number(at);
      if (channel.substr(1) == "position") {
        out.translation[axis] = value + (displaced ? bone.offset[axis] : 0);
      } else {
        out.rotation = out.rotation * Eigen::AngleAxisd(value * kDegree, Vec3::Unit(axis));
      }
    }
    return out;
  }

  const PlayedFile& file_;
  std::vector<Bone> bones_;
  std::vector<std::string> names_;
  std::vector<std::vector<LocalTransform>> frames_;
  double frame_time_ = 0;
};

}  // namespace

Played PlayBvh(const PlayedFile& file, const std::vector<PlayedJoint>& joints,
               const std::vector<double>& times) {
  return BvhPlayer(file).Play(joints, times);
}

}  // namespace retarget::io::playback
