#include "io/text/message.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/text/nearest_name.h"
#include "io/text/printable.h"

namespace retarget::io {
namespace {

constexpr int kDeepest = 24;
constexpr double kLargest = 1000;  // of a vector's numbers (m, degrees)

// What is there instead, short.
std::string Found(const Message& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return fmt::format("a list of {}", value.size());
  return Printable(value.dump(-1, ' ', true));
}

std::string Quoted(const std::string& text) { return "\"" + Printable(text) + "\""; }

[[noreturn]] void RefuseAt(const std::string& path, const std::string& expected,
                           const Message& found) {
  throw InputError(fmt::format("{}: expected {}, found {}", path, expected, Found(found)));
}

std::string Size(size_t most_bytes) {
  return fmt::format("a text of at most {} bytes", most_bytes);
}

int IndexOf(const std::string& path, const Message& value, const std::vector<std::string>& names) {
  if (!value.is_string()) RefuseAt(path, "a name", value);
  const std::string& word = value.get_ref<const std::string&>();
  const auto at = std::find(names.begin(), names.end(), word);
  if (at == names.end()) {
    throw InputError(
        fmt::format("{}: unknown name {}{}", path, Quoted(word), Suggestion(word, names)));
  }
  return static_cast<int>(at - names.begin());
}

std::string ItemOf(const std::string& path, size_t k) { return fmt::format("{}[{}]", path, k); }

}  // namespace

Message ParseMessage(std::string_view text) {
  const auto shallow = [](int depth, Message::parse_event_t, Message&) {
    if (depth > kDeepest) {
      throw InputError(fmt::format("the message is nested deeper than {} levels", kDeepest));
    }
    return true;
  };
  try {
    return Message::parse(text.begin(), text.end(), shallow);
  } catch (const nlohmann::json::parse_error& error) {
    throw InputError(fmt::format("the message is not JSON (at byte {})", error.byte));
  } catch (const nlohmann::json::exception&) {  // such as 1e999
    throw InputError("the message is not JSON: a number is out of range");
  }
}

Fields::Fields(const Message& object, std::string where)
    : object_(&object), where_(std::move(where)) {
  if (!object.is_object()) {
    RefuseAt(where_.empty() ? "the message" : where_, "an object {...}", object);
  }
}

std::string Fields::PathOf(const std::string& key) const {
  return where_.empty() ? key : where_ + "." + key;
}

void Fields::Only(const std::vector<std::string>& keys) const {
  for (const auto& item : object_->items()) {
    if (std::find(keys.begin(), keys.end(), item.key()) != keys.end()) continue;
    throw InputError(fmt::format("{}: unknown field{}", Printable(PathOf(item.key())),
                                 keys.empty() ? "" : Suggestion(item.key(), keys)));
  }
}

void Fields::Only(std::initializer_list<const char*> keys) const {
  Only(std::vector<std::string>(keys.begin(), keys.end()));
}

const Message* Fields::Find(const std::string& key) const {
  const auto at = object_->find(key);
  return at == object_->end() ? nullptr : &*at;
}

const Message& Fields::Require(const std::string& key) const {
  if (const Message* value = Find(key)) return *value;
  throw InputError(PathOf(key) + " is missing");
}

void Fields::Refuse(const std::string& key, const std::string& expected) const {
  RefuseAt(PathOf(key), expected, Require(key));
}

std::string Fields::Text(const std::string& key, size_t most_bytes) const {
  const Message& value = Require(key);
  if (!value.is_string()) Refuse(key, "a text");
  const auto& text = value.get_ref<const std::string&>();
  if (text.size() > most_bytes) {
    throw InputError(
        fmt::format("{}: expected {}, found {} bytes", PathOf(key), Size(most_bytes), text.size()));
  }
  return text;
}

double Fields::Number(const std::string& key, double least, double most) const {
  const Message& value = Require(key);
  const double x = value.is_number() ? value.get<double>() : NAN;
  if (!(x >= least && x <= most)) {
    Refuse(key, fmt::format("a number from {} to {}", least, most));
  }
  return x;
}

int Fields::Integer(const std::string& key, int least, int most) const {
  const Message& value = Require(key);
  // A number such as 3.0 is one, too: pages write no other.
  const double x = value.is_number() ? value.get<double>() : NAN;
  if (!(x >= least && x <= most) || x != std::floor(x)) {
    Refuse(key, fmt::format("a whole number from {} to {}", least, most));
  }
  return static_cast<int>(x);
}

bool Fields::Bool(const std::string& key) const {
  const Message& value = Require(key);
  if (!value.is_boolean()) Refuse(key, "true or false");
  return value.get<bool>();
}

double Fields::Number(const std::string& key, double least, double most, double absent) const {
  return Has(key) ? Number(key, least, most) : absent;
}

int Fields::Integer(const std::string& key, int least, int most, int absent) const {
  return Has(key) ? Integer(key, least, most) : absent;
}

bool Fields::Bool(const std::string& key, bool absent) const {
  return Has(key) ? Bool(key) : absent;
}

const Message& Fields::List(const std::string& key, size_t most) const {
  const Message& value = Require(key);
  if (!value.is_array() || value.size() > most) {
    Refuse(key, fmt::format("a list of at most {}", most));
  }
  return value;
}

Vec3 Fields::Vector(const std::string& key) const {
  const Message& value = Require(key);
  Vec3 v;
  bool good = value.is_array() && value.size() == 3;
  for (int k = 0; good && k < 3; ++k) {
    good = value[k].is_number() && std::abs(value[k].get<double>()) <= kLargest;
    if (good) v[k] = value[k].get<double>();
  }
  if (!good) Refuse(key, fmt::format("3 numbers from -{} to {}", kLargest, kLargest));
  return v;
}

Quat Fields::Rotation(const std::string& key) const {
  const Message& value = Require(key);
  Eigen::Vector4d q = Eigen::Vector4d::Zero();
  bool good = value.is_array() && value.size() == 4;
  for (int k = 0; good && k < 4; ++k) {
    good = value[k].is_number() && std::abs(value[k].get<double>()) <= kLargest;
    if (good) q[k] = value[k].get<double>();
  }
  if (!good || q.norm() < 1e-6) Refuse(key, "a quaternion [x, y, z, w]");
  return Quat(q[3], q[0], q[1], q[2]).normalized();
}

int Fields::Named(const std::string& key, const std::vector<std::string>& names) const {
  return IndexOf(PathOf(key), Require(key), names);
}

std::vector<int> Fields::NamedList(const std::string& key, const std::vector<std::string>& names,
                                   size_t most) const {
  std::vector<int> indices;
  for (const Message& item : List(key, most)) {
    indices.push_back(IndexOf(ItemOf(PathOf(key), indices.size()), item, names));
  }
  return indices;
}

std::vector<std::string> Fields::TextList(const std::string& key, size_t most,
                                          size_t most_bytes) const {
  std::vector<std::string> texts;
  for (const Message& item : List(key, most)) {
    if (!item.is_string() || item.get_ref<const std::string&>().size() > most_bytes) {
      RefuseAt(ItemOf(PathOf(key), texts.size()), Size(most_bytes), item);
    }
    texts.push_back(item.get<std::string>());
  }
  return texts;
}

Fields Fields::Object(const std::string& key) const { return Fields(Require(key), PathOf(key)); }

std::vector<Fields> Fields::ObjectList(const std::string& key, size_t most) const {
  std::vector<Fields> objects;
  for (const Message& item : List(key, most)) {
    objects.emplace_back(item, ItemOf(PathOf(key), objects.size()));
  }
  return objects;
}

}  // namespace retarget::io
