#include "tools/posing/argument_parser.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "io/template_keys.h"
#include "io/text/nearest_name.h"
#include "model/geometry/so3.h"

namespace retarget::posing {

std::vector<std::string> Split(const std::string& text, char at) {
  std::vector<std::string> parts;
  size_t first = 0;
  for (;;) {
    const size_t next = text.find(at, first);
    parts.push_back(text.substr(first, next - first));
    if (next == std::string::npos) return parts;
    first = next + 1;
  }
}

std::pair<std::string, std::string> ArgumentParser::Pair() const {
  const size_t at = value_.find('=');
  if (at == std::string::npos) throw InputError("expected \"=\"");
  return {value_.substr(0, at), value_.substr(at + 1)};
}

ArgumentParser::Place ArgumentParser::NodeAt(const std::string& word) const {
  const auto [figure, name] = Slash(word);
  return {figure, Node(figure, name)};
}

ArgumentParser::Place ArgumentParser::LinkAt(const std::string& word) const {
  const auto [figure, name] = Slash(word);
  return {figure, Named(name, "joint", io::LinkNames(posture_.body[figure]))};
}

int ArgumentParser::Node(int figure, std::string name) const {
  if (name.ends_with("_foot")) name.replace(name.size() - 4, 4, "ankle");
  return Named(name, "node", io::NodeNames(posture_.body[figure]));
}

std::vector<double> ArgumentParser::Numbers(const std::string& text,
                                            const std::vector<size_t>& counts) {
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

Quat ArgumentParser::Rotation(const Vec3& degrees) { return ExpSo3(kDegree * degrees); }

int ArgumentParser::Named(const std::string& word, const char* what,
                          const std::vector<std::string>& names) {
  const auto at = std::find(names.begin(), names.end(), word);
  if (at == names.end()) {
    throw InputError(fmt::format("unknown {} \"{}\"{}", what, word, io::Suggestion(word, names)));
  }
  return static_cast<int>(at - names.begin());
}

HoldRequest ArgumentParser::HoldFrom(const std::string& text) const {
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

int ArgumentParser::HoldIndex(const std::string& text) const {
  return static_cast<int>(std::lround(Numbers(text, {1})[0])) - 1;
}

Path ArgumentParser::PathOf(int figure, const std::string& text) const {
  const size_t at = text.find("..");
  if (at == std::string::npos) throw InputError("expected a path such as left_hand..right_hand");
  const int from = Node(figure, text.substr(0, at)), to = Node(figure, text.substr(at + 2));
  return {std::min(from, to), std::max(from, to)};
}

std::pair<int, std::string> ArgumentParser::Slash(const std::string& word) const {
  const size_t at = word.find('/');
  if (at == std::string::npos) {
    throw InputError(
        fmt::format("expected figure and name such as a/left_hand, found \"{}\"", word));
  }
  return {Figure(word.substr(0, at)), word.substr(at + 1)};
}

}  // namespace retarget::posing
