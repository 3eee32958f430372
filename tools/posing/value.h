// The value of one posing option, read against the posture as it is. Inner part of
// tools/posing/words.h; everything throws InputError.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "io/template_keys.h"
#include "io/text/nearest_name.h"
#include "model/geometry/so3.h"
#include "tools/posing/state.h"

namespace retarget::posing {

inline std::vector<std::string> Split(const std::string& text, char at) {
  std::vector<std::string> parts;
  size_t first = 0;
  for (;;) {
    const size_t next = text.find(at, first);
    parts.push_back(text.substr(first, next - first));
    if (next == std::string::npos) return parts;
    first = next + 1;
  }
}

class Words {
 public:
  Words(const std::string& value, const PoseState& state)
      : value_(value), posture_(state.posture) {}

  const std::string& value() const { return value_; }

  // "left=right" in two; a part without "=" is refused.
  std::pair<std::string, std::string> Pair() const {
    const size_t at = value_.find('=');
    if (at == std::string::npos) throw InputError("expected \"=\"");
    return {value_.substr(0, at), value_.substr(at + 1)};
  }

  int Figure(const std::string& word) const { return Named(word, "figure", {"a", "b"}); }

  struct Place {
    int figure, index;
  };
  Place NodeAt(const std::string& word) const {
    const auto [figure, name] = Slash(word);
    return {figure, Node(figure, name)};
  }
  int Node(int figure, std::string name) const {
    if (name.ends_with("_foot")) name.replace(name.size() - 4, 4, "ankle");
    return Named(name, "node", io::NodeNames(posture_.body[figure]));
  }
  Place LinkAt(const std::string& word) const {
    const auto [figure, name] = Slash(word);
    return {figure, Named(name, "joint", io::LinkNames(posture_.body[figure]))};
  }

  // As many numbers as one of `counts`.
  static std::vector<double> Numbers(const std::string& text, const std::vector<size_t>& counts) {
    std::vector<double> numbers;
    for (const std::string& part : Split(text, ',')) {
      size_t used = 0;
      double x = NAN;
      try {
        x = std::stod(part, &used);
      } catch (const std::exception&) {
      }
      if (used != part.size() || !std::isfinite(x)) {
        throw InputError(fmt::format("expected a number, found \"{}\"", part));
      }
      numbers.push_back(x);
    }
    if (std::find(counts.begin(), counts.end(), numbers.size()) == counts.end()) {
      throw InputError(
          fmt::format("expected {} numbers, found {}", fmt::join(counts, " or "), numbers.size()));
    }
    return numbers;
  }
  static Vec3 Vector(const std::string& text) { return VectorAt(Numbers(text, {3}), 0); }
  static Vec3 VectorAt(const std::vector<double>& x, size_t at) {
    return Vec3(x[at], x[at + 1], x[at + 2]);
  }
  static Quat Rotation(const Vec3& degrees) { return ExpSo3(kDegree * degrees); }

  static int Named(const std::string& word, const char* what,
                   const std::vector<std::string>& names) {
    const auto at = std::find(names.begin(), names.end(), word);
    if (at == names.end()) {
      throw InputError(fmt::format("unknown {} \"{}\"{}", what, word, io::Suggestion(word, names)));
    }
    return static_cast<int>(at - names.begin());
  }

  // FROM=TO[,rotation], FROM figure/node, TO figure/node, "world" or world:x,y,z.
  HoldRequest HoldFrom(const std::string& text) const {
    const size_t at = text.find('=');
    if (at == std::string::npos) throw InputError("expected from=to");
    const Place from = NodeAt(text.substr(0, at));
    std::string to = text.substr(at + 1);
    HoldRequest hold;
    hold.from = {from.figure, from.index, Vec3::Zero()};
    if (to.ends_with(",rotation")) {
      hold.rotation = true;
      to.resize(to.size() - 9);
    }
    if (to == "world" || to.starts_with("world:")) {
      hold.to_figure = kWorld;
      if (to != "world") hold.to_offset = Vector(to.substr(6));
      return hold;
    }
    const Place node = NodeAt(to);
    hold.to_figure = node.figure;
    hold.to_node = node.index;
    return hold;
  }

  int HoldIndex(const std::string& text) const {
    return static_cast<int>(std::lround(Numbers(text, {1})[0])) - 1;
  }

  // "left_hand..right_hand", figure f.
  Path PathOf(int figure, const std::string& text) const {
    const size_t at = text.find("..");
    if (at == std::string::npos) throw InputError("expected a path such as left_hand..right_hand");
    const int from = Node(figure, text.substr(0, at)), to = Node(figure, text.substr(at + 2));
    return {std::min(from, to), std::max(from, to)};
  }

 private:
  std::pair<int, std::string> Slash(const std::string& word) const {
    const size_t at = word.find('/');
    if (at == std::string::npos) {
      throw InputError(
          fmt::format("expected figure and name such as a/left_hand, found \"{}\"", word));
    }
    return {Figure(word.substr(0, at)), word.substr(at + 1)};
  }

  std::string value_;
  const TemplatePosture& posture_;
};

}  // namespace retarget::posing
