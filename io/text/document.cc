#include "io/text/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "io/text/json.h"
#include "io/text/nearest_name.h"
#include "io/text/quoted.h"

namespace retarget::io {
namespace {

constexpr double kLargestPart = 1000;  // of a quaternion

// A finite decimal number, and nothing else.
std::optional<double> ParsedNumber(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

bool IsWholeText(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::string WithUnit(const std::string& unit) { return unit.empty() ? "" : " (" + unit + ")"; }

std::string JoinedPath(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

}  // namespace

Document::Document(Notation notation, std::string name, DocumentNode root)
    : notation_(notation), name_(std::move(name)), root_(std::move(root)) {}

Value Document::root() const { return Value(this, &root_, ""); }

// -- Places and refusals -------------------------------------------------------------------------

std::string Value::Place() const {
  if (!IsYaml() || node_->line == 0) return document_->name_;
  return fmt::format("{}:{}", document_->name_, node_->line);
}

std::string Value::PathOf(const std::string& key) const { return JoinedPath(path_, key); }

std::string Value::Described() const {
  if (kind() == Kind::kList) return fmt::format("a list of {}", size());
  if (!IsYaml()) {
    if (kind() == Kind::kMap) return "an object";
    if (kind() == Kind::kNothing) return "null";
    return Printable(node_->quoted ? JsonText(text()) : text());
  }
  if (kind() == Kind::kMap) return "a map";
  if (kind() == Kind::kNothing) return "nothing";
  return (node_->quoted ? "the text " : "") + Quoted(text());
}

void Value::Refuse(const std::string& message) const {
  if (!IsYaml()) throw InputError((path_.empty() ? "the message" : path_) + ": " + message);
  throw InputError(Place() + ": " + (path_.empty() ? "" : path_ + ": ") + message);
}

void Value::RefuseExpecting(const std::string& expected) const {
  Refuse("expected " + expected + ", found " + Described());
}

// -- Maps and lists ------------------------------------------------------------------------------

Value Value::Child(const DocumentNode& child) const {
  if (kind() == Kind::kMap) return Value(document_, &child, PathOf(child.key));
  return Value(document_, &child, fmt::format("{}[{}]", path_, &child - node_->children.data()));
}

void Value::CheckMap() const {
  if (kind() == Kind::kMap) return;
  RefuseExpecting(IsYaml() ? "a map of keys and values" : "an object {...}");
}

const DocumentNode* Value::FindNode(std::string_view key) const {
  CheckMap();
  const auto at = std::find_if(node_->children.begin(), node_->children.end(),
                               [&](const DocumentNode& child) { return child.key == key; });
  return at == node_->children.end() ? nullptr : &*at;
}

std::optional<Value> Value::Find(std::string_view key) const {
  const DocumentNode* child = FindNode(key);
  return child ? std::optional(Child(*child)) : std::nullopt;
}

bool Value::Has(std::string_view key) const { return FindNode(key) != nullptr; }

bool Value::Flag(std::string_view key) const {
  const std::optional<Value> flag = Find(key);
  return flag && flag->Bool();
}

Value Value::Require(const std::string& key) const {
  if (const DocumentNode* child = FindNode(key)) return Child(*child);
  if (!IsYaml()) throw InputError(PathOf(key) + " is missing");
  throw InputError(Place() + ": missing key \"" + PathOf(key) + "\"");
}

void Value::CheckKeys(const std::vector<std::string>& known) const {
  CheckMap();
  for (const DocumentNode& node : node_->children) {
    if (std::find(known.begin(), known.end(), node.key) != known.end()) continue;
    const Value child = Child(node);
    if (!IsYaml()) {
      throw InputError(Printable(child.path_) + ": unknown field" +
                       (known.empty() ? "" : Suggestion(node.key, known)));
    }
    throw InputError(child.Place() + ": unknown key \"" + child.path_ + "\"" +
                     Suggestion(node.key, known, PathOf("")));
  }
}

std::vector<Value> Value::Items() const {
  std::vector<Value> items;
  for (const DocumentNode& child : node_->children) items.push_back(Child(child));
  return items;
}

std::vector<Value> Value::List() const {
  if (kind() != Kind::kList) RefuseExpecting("a list");
  return Items();
}

std::vector<Value> Value::List(size_t most) const {
  if (kind() != Kind::kList || size() > most) {
    RefuseExpecting(fmt::format("a list of at most {}", most));
  }
  return Items();
}

// -- Scalars and lists of numbers ----------------------------------------------------------------

double Value::Number(double least, double most, const std::string& unit) const {
  const auto number = IsPlain() ? ParsedNumber(text()) : std::nullopt;
  if (!number || *number < least || *number > most) {
    RefuseExpecting(
        fmt::format("a number from {} to {}{}", least, most, IsYaml() ? WithUnit(unit) : ""));
  }
  return *number;
}

int Value::Integer(int least, int most) const {
  const auto number = IsPlain() ? ParsedNumber(text()) : std::nullopt;
  // JSON writes one as 3.0, too.
  const bool whole = number && (IsYaml() ? IsWholeText(text()) : *number == std::floor(*number));
  if (!whole || *number < least || *number > most) {
    RefuseExpecting(fmt::format("a whole number from {} to {}", least, most));
  }
  return static_cast<int>(*number);
}

bool Value::Bool() const {
  const bool is_true = text() == "true";
  if (!IsPlain() || (!is_true && text() != "false")) RefuseExpecting("true or false");
  return is_true;
}

std::string Value::Text(size_t most_bytes) const {
  if (kind() != Kind::kScalar || (!IsYaml() && !node_->quoted)) {
    RefuseExpecting(IsYaml() ? "text" : "a text");
  }
  if (text().size() > most_bytes) {
    Refuse(fmt::format("expected a text of at most {} bytes, found {} bytes", most_bytes,
                       text().size()));
  }
  return text();
}

std::vector<std::string> Value::Texts(size_t most, size_t most_bytes) const {
  std::vector<std::string> texts;
  for (const Value& item : List(most)) texts.push_back(item.Text(most_bytes));
  return texts;
}

int Value::Name(const std::string& what, const std::vector<std::string>& names) const {
  if (kind() != Kind::kScalar || (!IsYaml() && !node_->quoted)) {
    RefuseExpecting(IsYaml() ? "the name of a " + what : "a name");
  }
  const auto found = std::find(names.begin(), names.end(), text());
  if (found == names.end()) {
    Refuse("unknown " + (IsYaml() ? what : "name") + " " + Quoted(text()) +
           Suggestion(text(), names));
  }
  return static_cast<int>(found - names.begin());
}

VecX Value::Numbers(int count, double least, double most, const std::string& unit) const {
  const bool fits = kind() == Kind::kList && static_cast<int>(size()) == count;
  VecX numbers(count);
  if (IsYaml()) {
    if (!fits) RefuseExpecting(fmt::format("a list of {} numbers{}", count, WithUnit(unit)));
    for (int k = 0; k < count; ++k) {
      numbers[k] = Child(node_->children[k]).Number(least, most, unit);
    }
    return numbers;
  }
  for (int k = 0; k < count; ++k) {
    const DocumentNode* child = fits ? &node_->children[k] : nullptr;
    const bool plain = child && child->kind == Kind::kScalar && !child->quoted;
    const auto number = plain ? ParsedNumber(child->text) : std::nullopt;
    if (!number || *number < least || *number > most) {
      RefuseExpecting(fmt::format("{} numbers from {} to {}", count, least, most));
    }
    numbers[k] = *number;
  }
  return numbers;
}

Vec3 Value::Vector(double most, const std::string& unit) const {
  return Numbers(3, -most, most, unit);
}

Quat Value::Quaternion() const {
  Eigen::Vector4d q = Eigen::Vector4d::Zero();
  try {
    q = Numbers(4, -kLargestPart, kLargestPart);
  } catch (const InputError&) {  // said below
  }
  if (q.norm() < 1e-6) RefuseExpecting("a quaternion [x, y, z, w]");
  return Quat(q[3], q[0], q[1], q[2]).normalized();
}

}  // namespace retarget::io
