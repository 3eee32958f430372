#include "io/settings_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "io/text/nearest_name.h"
#include "io/text/yaml.h"

namespace retarget::io {
namespace {

// A key of the table is "group.name".
std::string GroupOf(const std::string& key) { return key.substr(0, key.find('.')); }
std::string NameOf(const std::string& key) { return key.substr(key.find('.') + 1); }

std::vector<std::string> AllKeys() {
  std::vector<std::string> keys;
  const Settings defaults;
  VisitSettings(defaults, [&](const char* key, auto&&...) { keys.push_back(key); });
  return keys;
}

std::vector<std::string> Groups() {
  std::vector<std::string> groups;
  for (const std::string& key : AllKeys()) {
    if (groups.empty() || groups.back() != GroupOf(key)) groups.push_back(GroupOf(key));
  }
  return groups;
}

std::vector<std::string> NamesIn(const std::string& group) {
  std::vector<std::string> names;
  for (const std::string& key : AllKeys()) {
    if (GroupOf(key) == group) names.push_back(NameOf(key));
  }
  return names;
}

// One overload per type of setting, so that VisitSettings finds its way.
void ReadInto(double* out, const Value& value, const char* unit, double least, double most) {
  *out = value.Number(least, most, unit);
}
void ReadInto(int* out, const Value& value, const char*, double least, double most) {
  *out = value.Integer(static_cast<int>(least), static_cast<int>(most));
}
template <typename Enum>
void ReadInto(Enum* out, const Value& value, const char*, double, double) {
  const auto& names = kNamesOf<Enum>;
  *out = static_cast<Enum>(value.Name("value", {names.begin(), names.end()}));
}
void ReadInto(std::vector<double>* out, const Value& value, const char*, double, double) {
  *out = ParseStages(value.Text());
}

// Sets the setting that `value.path()` names; it must exist.
void Assign(Settings* settings, const Value& value) {
  VisitSettings(*settings, [&](const char* key, auto& setting, const char* unit, const char*,
                               double least, double most) {
    if (value.path() == key) ReadInto(&setting, value, unit, least, most);
  });
}

// As a value of YAML.
template <typename T>
std::string Printed(const T& setting) {
  if constexpr (std::is_arithmetic_v<T>) return fmt::format("{}", setting);
  return YamlText(fmt::format("{}", Written(setting)));
}

// What a setting may be, for its comment.
template <typename T>
std::string AllowedText(const T&) {
  if constexpr (std::is_enum_v<T>) return fmt::format(" ({})", fmt::join(kNamesOf<T>, "|"));
  return "";
}

std::vector<std::string> PrintedDefaults() {
  std::vector<std::string> printed;
  const Settings defaults;
  VisitSettings(defaults, [&](const char*, const auto& setting, auto&&...) {
    printed.push_back(fmt::format("{}", Written(setting)));
  });
  return printed;
}

std::string Trimmed(const std::string& text) {
  const size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

}  // namespace

Settings ReadSettings(const std::string& path) {
  return ParseSettings(ReadYamlFile(path, "a settings file"), path);
}

Settings ParseSettings(const std::string& text, const std::string& name) {
  Settings settings;
  const Document document = ParseYaml(text, name);
  const Value root = document.root();
  if (root.is_null()) return settings;
  root.CheckKeys(Groups());
  for (const Value& group : root.Items()) {
    if (group.is_null()) continue;  // every key of it is commented out
    group.CheckKeys(NamesIn(group.key()));
    for (const Value& value : group.Items()) Assign(&settings, value);
  }
  return settings;
}

void SetByName(Settings* settings, const std::string& assignment, const std::string& name) {
  const size_t equals = assignment.find('=');
  const auto scalar = [](const std::string& text) {
    return DocumentNode{DocumentNode::Kind::kScalar, text, false, "", 0};
  };
  if (equals == std::string::npos) {
    Document(Notation::kYaml, name, scalar(assignment)).root().RefuseExpecting("key=value");
  }
  const std::string key = Trimmed(assignment.substr(0, equals));
  Document(Notation::kYaml, name, scalar(key)).root().Name("key", AllKeys());
  DocumentNode map{
      DocumentNode::Kind::kMap, "", false, "", 0, {scalar(Trimmed(assignment.substr(equals + 1)))}};
  map.children[0].key = key;
  const Document document(Notation::kYaml, name, map);
  Assign(settings, document.root().Require(key));
}

std::string FormatSettings(const Settings& settings) {
  const std::vector<std::string> defaults = PrintedDefaults();
  std::string out, group;
  size_t index = 0;
  VisitSettings(settings, [&](const std::string& key, const auto& setting, const std::string& unit,
                              const char* meaning, double, double) {
    if (GroupOf(key) != group) {
      out += (out.empty() ? "" : "\n") + GroupOf(key) + ":\n";
      group = GroupOf(key);
    }
    out += fmt::format("  {}: {}  # default {}{}: {}{}\n", NameOf(key), Printed(setting),
                       defaults[index++], unit.empty() ? "" : ", " + unit, meaning,
                       AllowedText(setting));
  });
  return out;
}

}  // namespace retarget::io
