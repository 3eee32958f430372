// The value of one posing option, read against the posture as it is. Inner part of
// tools/posing/command_line.h; everything throws InputError.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tools/posing/state.h"

namespace retarget::posing {

// The parts between the characters `at`: one more than there are of them.
std::vector<std::string> Split(const std::string& text, char at);

class ArgumentParser {
 public:
  ArgumentParser(const std::string& value, const PoseState& state)
      : value_(value), posture_(state.posture) {}

  const std::string& value() const { return value_; }

  // "left=right" in two; a part without "=" is refused.
  std::pair<std::string, std::string> Pair() const;

  int Figure(const std::string& word) const { return Named(word, "figure", {"a", "b"}); }

  struct Place {
    int figure, index;
  };
  Place NodeAt(const std::string& word) const;  // "a/left_hand"
  Place LinkAt(const std::string& word) const;
  // `left_foot` and `right_foot` mean the ankles.
  int Node(int figure, std::string name) const;

  // As many numbers as one of `counts`.
  static std::vector<double> Numbers(const std::string& text, const std::vector<size_t>& counts);
  static Vec3 Vector(const std::string& text) { return VectorAt(Numbers(text, {3}), 0); }
  static Vec3 VectorAt(const std::vector<double>& x, size_t at) {
    return Vec3(x[at], x[at + 1], x[at + 2]);
  }
  static Quat Rotation(const Vec3& degrees);

  // The index in `names`.
  static int Named(const std::string& word, const char* what,
                   const std::vector<std::string>& names);

  // FROM=TO[,rotation], FROM figure/node, TO figure/node, "world" or world:x,y,z.
  HoldRequest HoldFrom(const std::string& text) const;
  int HoldIndex(const std::string& text) const;  // from 1 in the text, from 0 here
  // "left_hand..right_hand".
  Path PathOf(int figure, const std::string& text) const;

 private:
  std::pair<int, std::string> Slash(const std::string& word) const;

  std::string value_;
  const TemplatePosture& posture_;
};

}  // namespace retarget::posing
