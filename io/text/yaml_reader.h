// Strict YAML. yaml-cpp parses; what it lets pass is refused here: keys given twice, anchors and
// aliases, tags, a second document, deep nesting. Every value knows its place in the file, so that
// every complaint is one line of the form
//   file:line: dotted.path: expected ..., found ...
// All functions throw InputError. Lines count from 1, list items ("holds[0]") from 0.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/geometry/types.h"

namespace retarget::io {

struct YamlValue {
  enum class Kind { kNothing, kScalar, kList, kMap };
  Kind kind = Kind::kNothing;
  std::string text;                 // of a scalar
  bool quoted = false;              // a scalar in quotes (or a block of text): never a number
  std::string key;                  // under which the value stands in its map
  std::vector<YamlValue> children;  // of a list or a map, in the file's order
  std::string path;                 // "a.root.position", "holds[0].from"; empty at the top
  std::string place;                // "file:line", of the key where there is one

  // The value under `key`, null where there is none.
  const YamlValue* Find(std::string_view wanted) const;
};

// The whole of a file of at most 4 MB; `expected` says what it should be ("a settings file").
std::string ReadTextFile(const std::string& path, const std::string& expected);

// The one document in `text`; `name` stands for the file in messages. Nothing for an empty text.
YamlValue ParseYaml(const std::string& text, const std::string& name);

// Throws "place: path: message".
[[noreturn]] void Refuse(const YamlValue& value, const std::string& message);
// Throws "place: path: expected ..., found ...".
[[noreturn]] void RefuseExpecting(const YamlValue& value, const std::string& expected);

// `value` must be a map with no other keys than `known`.
void CheckKeys(const YamlValue& value, const std::vector<std::string>& known);
// The value under `key` of a map, which must be there.
const YamlValue& Require(const YamlValue& map, const std::string& key);

// The items of a list.
const std::vector<YamlValue>& ReadList(const YamlValue& value);
// A finite decimal number from `least` to `most`, not in quotes; `unit` may be empty.
double ReadNumber(const YamlValue& value, double least, double most, const std::string& unit);
int ReadInteger(const YamlValue& value, int least, int most);
// `count` such numbers in a list.
VecX ReadNumbers(const YamlValue& value, int count, double least, double most,
                 const std::string& unit);
// true or false.
bool ReadBool(const YamlValue& value);
// Any scalar, as it is written.
std::string ReadText(const YamlValue& value);
// The index of the scalar in `names`; `what` says what they are ("node").
int ReadName(const YamlValue& value, const std::string& what,
             const std::vector<std::string>& names);

// `text` as a YAML scalar on one line, in quotes where it needs them.
std::string YamlText(const std::string& text);

}  // namespace retarget::io
