#include "io/recognition/joint_names.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

#include "io/recognition/joint_profiles.h"
#include "model/rig/tree.h"

namespace retarget::io {
namespace {

constexpr size_t kMostFrames = 24;  // tried per convention: keeps the cost of odd input small

// The name up to a number at its end, "_07"; all of it where there is none.
std::string_view WithoutNumber(std::string_view name) {
  size_t end = name.size();
  while (end > 0 && std::isdigit(static_cast<unsigned char>(name[end - 1]))) --end;
  return end > 1 && end < name.size() && name[end - 1] == '_' ? name.substr(0, end - 1) : name;
}

}  // namespace

std::vector<std::string> SplitWords(std::string_view text, char separator) {
  std::vector<std::string> words;
  while (!text.empty()) {
    const size_t end = std::min(text.find(separator), text.size());
    if (end > 0) words.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

std::string NormalisedName(std::string_view name) {
  if (const size_t space = name.find_last_of(":|"); space != std::string_view::npos) {
    name.remove_prefix(space + 1);
  }
  std::string out;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80 && !std::isalnum(byte)) continue;
    out += byte < 0x80 ? static_cast<char>(std::tolower(byte)) : c;
  }
  return out;
}

bool NamesAreNumbered(const Rig& rig) {
  constexpr double kNearlyAll = 0.8;
  int numbered = 0;
  std::set<std::string> numbers;
  for (const RigJoint& joint : rig.joints) {
    const size_t kept = WithoutNumber(joint.name).size();
    if (kept == joint.name.size()) continue;
    ++numbered;
    numbers.insert(joint.name.substr(kept));
  }
  return numbered > kNearlyAll * rig.num_joints() &&
         static_cast<double>(numbers.size()) > kNearlyAll * numbered;
}

NameIndex::NameIndex(const Rig& rig, bool without_numbers) : rig_(rig) {
  for (int j = 0; j < rig.num_joints(); ++j) {
    const std::string_view name = rig.joints[j].name;
    names_.push_back(NormalisedName(without_numbers ? WithoutNumber(name) : name));
    joints_[names_.back()].push_back(j);
  }
}

int NameIndex::Find(const std::string& name) const {
  const auto found = joints_.find(name);
  return found == joints_.end() ? -1 : found->second.front();
}

int NameIndex::FindBelow(const std::string& name, int ancestor) const {
  const auto found = joints_.find(name);
  if (found == joints_.end()) return -1;
  for (const int joint : found->second) {
    if (joint != ancestor && DescendsFrom(rig_, joint, ancestor)) return joint;
  }
  return -1;
}

int NameIndex::Count(const std::string& name) const {
  const auto found = joints_.find(name);
  return found == joints_.end() ? 0 : static_cast<int>(found->second.size());
}

std::vector<NameFrame> NameIndex::Frames(const std::vector<std::string>& words,
                                         const std::vector<std::string>& preferred,
                                         int least) const {
  std::set<std::pair<std::string, std::string>> seen = {{"", ""}};
  std::vector<NameFrame> frames = {{}};
  for (const std::string& name : names_) {
    for (const std::string& word : words) {
      const size_t at = name.find(word);
      if (at == std::string::npos || seen.size() >= kMostFrames) continue;
      const NameFrame frame = {name.substr(0, at), name.substr(at + word.size())};
      if (!seen.insert({frame.prefix, frame.suffix}).second) continue;
      const auto count = std::count_if(names_.begin(), names_.end(), [&](const std::string& n) {
        return n.starts_with(frame.prefix) && n.ends_with(frame.suffix);
      });
      if (count >= least) frames.push_back(frame);
    }
  }
  const auto rank = [&](const NameFrame& frame) {
    if (frame.prefix.empty() && frame.suffix.empty()) return size_t{0};
    const auto found = std::find(preferred.begin(), preferred.end(), frame.prefix);
    return 1 + static_cast<size_t>(found - preferred.begin()) + (frame.suffix.empty() ? 0 : 100);
  };
  std::stable_sort(frames.begin(), frames.end(),
                   [&](const NameFrame& a, const NameFrame& b) { return rank(a) < rank(b); });
  return frames;
}

}  // namespace retarget::io
