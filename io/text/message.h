// Messages of others as JSON, read strictly: every refusal is one sentence that names the field and
// says what was expected.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "model/geometry/types.h"

namespace retarget::io {

// Keys sorted, so that an object with very many of them costs no more than its length.
using Message = nlohmann::json;

// Throws InputError where the text is no JSON, or nested deeper than 24 levels.
Message ParseMessage(std::string_view text);

// A JSON object, seen from its place in the message: "ops[0].from". All methods throw InputError.
class Fields {
 public:
  Fields(const Message& object, std::string where);

  // Refuses every other field.
  void Only(std::initializer_list<const char*> keys) const;
  void Only(const std::vector<std::string>& keys) const;

  // Null where it is not there.
  const Message* Find(const std::string& key) const;
  const Message& Require(const std::string& key) const;
  bool Has(const std::string& key) const { return Find(key) != nullptr; }

  std::string Text(const std::string& key, size_t most_bytes) const;
  double Number(const std::string& key, double least, double most) const;
  int Integer(const std::string& key, int least, int most) const;
  bool Bool(const std::string& key) const;
  // The same, with what is meant where the field is absent.
  double Number(const std::string& key, double least, double most, double absent) const;
  int Integer(const std::string& key, int least, int most, int absent) const;
  bool Bool(const std::string& key, bool absent) const;

  Vec3 Vector(const std::string& key) const;    // of three numbers, at most 1000 in size
  Quat Rotation(const std::string& key) const;  // [x, y, z, w], normalised
  // Index of one of `names`.
  int Named(const std::string& key, const std::vector<std::string>& names) const;
  // Indices of a list of them.
  std::vector<int> NamedList(const std::string& key, const std::vector<std::string>& names,
                             size_t most) const;
  std::vector<std::string> TextList(const std::string& key, size_t most, size_t most_bytes) const;
  Fields Object(const std::string& key) const;
  std::vector<Fields> ObjectList(const std::string& key, size_t most) const;

  // "ops[0].target", for messages.
  std::string PathOf(const std::string& key) const;
  [[noreturn]] void Refuse(const std::string& key, const std::string& expected) const;

 private:
  const Message& List(const std::string& key, size_t most) const;

  const Message* object_;
  std::string where_;
};

}  // namespace retarget::io
