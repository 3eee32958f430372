// The names of a rig's joints, ready to be compared with a convention. Inner part of
// io/recognition/joint_profiles.h.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "model/rig/rig.h"

namespace retarget::io {

// What stands before and after the words of a convention in a rig's names: a character's name
// ("Character1_"), a tool's mark ("DEF-", "_JNT", ".001").
struct NameFrame {
  std::string prefix, suffix;  // normalised
};

class NameIndex {
 public:
  // With `without_numbers`, "_12" at the end of a name is left out (Sketchfab numbers all nodes).
  NameIndex(const Rig& rig, bool without_numbers);

  // The first joint of that normalised name, -1 where there is none.
  int Find(const std::string& name) const;
  // The first such joint below `ancestor`.
  int FindBelow(const std::string& name, int ancestor) const;
  int Count(const std::string& name) const;  // joints of that name
  const std::string& NameOf(int joint) const { return names_[static_cast<size_t>(joint)]; }

  // The frames in which one of `words` stands and which at least `least` names share; the plain one
  // first, then those with one of the `preferred` prefixes, in that order.
  std::vector<NameFrame> Frames(const std::vector<std::string>& words,
                                const std::vector<std::string>& preferred, int least) const;

 private:
  const Rig& rig_;
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::vector<int>> joints_;
};

// Whether nearly all names end in a number of their own, "_07".
bool NamesAreNumbered(const Rig& rig);

// Text between separators.
std::vector<std::string> SplitWords(std::string_view text, char separator = ' ');

}  // namespace retarget::io
