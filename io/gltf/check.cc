#include "io/gltf/check.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "io/text/quoted.h"
#include "model/geometry/types.h"

namespace retarget::io {
namespace {

using nlohmann::json;

enum class Kind { kText, kFlag, kCount, kIndex, kIndices, kNumbers, kObject, kArray };

// A member that is known: its kind, and of which array an index is, or how many numbers there are.
struct Field {
  const char* key;
  Kind kind;
  bool required = false;
  const char* of = "";
  size_t size = 0;
};

const std::vector<Field> kNode = {{"name", Kind::kText},
                                  {"children", Kind::kIndices, false, "nodes"},
                                  {"mesh", Kind::kIndex, false, "meshes"},
                                  {"skin", Kind::kIndex, false, "skins"},
                                  {"matrix", Kind::kNumbers, false, "", 16},
                                  {"translation", Kind::kNumbers, false, "", 3},
                                  {"rotation", Kind::kNumbers, false, "", 4},
                                  {"scale", Kind::kNumbers, false, "", 3}};
const std::vector<Field> kSkin = {{"name", Kind::kText},
                                  {"joints", Kind::kIndices, true, "nodes"},
                                  {"skeleton", Kind::kIndex, false, "nodes"},
                                  {"inverseBindMatrices", Kind::kIndex, false, "accessors"}};
const std::vector<Field> kAnimation = {
    {"name", Kind::kText}, {"channels", Kind::kArray, true}, {"samplers", Kind::kArray, true}};
const std::vector<Field> kChannel = {{"sampler", Kind::kCount, true},
                                     {"target", Kind::kObject, true}};
const std::vector<Field> kTarget = {{"node", Kind::kIndex, false, "nodes"},
                                    {"path", Kind::kText, true}};
const std::vector<Field> kSampler = {{"input", Kind::kIndex, true, "accessors"},
                                     {"output", Kind::kIndex, true, "accessors"},
                                     {"interpolation", Kind::kText}};
const std::vector<Field> kAccessor = {{"bufferView", Kind::kIndex, false, "bufferViews"},
                                      {"byteOffset", Kind::kCount},
                                      {"componentType", Kind::kCount, true},
                                      {"normalized", Kind::kFlag},
                                      {"count", Kind::kCount, true},
                                      {"type", Kind::kText, true},
                                      {"sparse", Kind::kObject}};
const std::vector<Field> kView = {{"buffer", Kind::kIndex, true, "buffers"},
                                  {"byteOffset", Kind::kCount},
                                  {"byteLength", Kind::kCount, true},
                                  {"byteStride", Kind::kCount}};
const std::vector<Field> kBuffer = {{"uri", Kind::kText}, {"byteLength", Kind::kCount, true}};

class Checker {
 public:
  Checker(const json& document, const std::string& name) : document_(document), name_(name) {}

  json Checked() const {
    if (!document_.is_object()) Fail("the document", "an object");
    json out = {{"asset", {{"version", Version()}}}};
    const std::pair<const char*, const std::vector<Field>*> arrays[] = {{"nodes", &kNode},
                                                                        {"skins", &kSkin},
                                                                        {"accessors", &kAccessor},
                                                                        {"bufferViews", &kView},
                                                                        {"buffers", &kBuffer}};
    for (const auto& [key, fields] : arrays) {
      for (size_t i = 0; i < SizeOf(key); ++i) {
        out[key].push_back(Take(document_[key][i], *fields, fmt::format("{}[{}]", key, i)));
      }
    }
    for (size_t i = 0; i < SizeOf("nodes"); ++i) {  // tinygltf would drop what it does not expect
      const json& node = out["nodes"][i];
      if (!node.contains("matrix")) continue;
      if (node.contains("translation") || node.contains("rotation") || node.contains("scale")) {
        Fail(fmt::format("nodes[{}]", i), "either a matrix or translation, rotation and scale");
      }
    }
    for (size_t i = 0; i < SizeOf("animations"); ++i) {
      out["animations"].push_back(CheckedAnimation(i));
    }
    for (size_t i = 0; i < SizeOf("meshes"); ++i) out["meshes"].push_back(CheckedMesh(i));
    return out;
  }

 private:
  [[noreturn]] void Fail(const std::string& place, const std::string& expected) const {
    throw InputError(fmt::format("{}: {}: expected {}", name_, place, expected));
  }

  // Length of an array of the document; 0 where it has none.
  size_t SizeOf(const char* key) const {
    const auto it = document_.find(key);
    if (it == document_.end()) return 0;
    if (!it->is_array()) Fail(key, "an array");
    return it->size();
  }

  std::string Version() const {
    const auto asset = document_.find("asset");
    if (asset == document_.end() || !asset->is_object()) Fail("asset", "an object");
    const auto version = asset->find("version");
    if (version == asset->end() || !version->is_string()) Fail("asset.version", "\"2.0\"");
    const std::string text = *version;
    if (text.substr(0, 2) != "2.") {
      Fail("asset.version", fmt::format("\"2.0\", found \"{}\"", Printable(text)));
    }
    return text;
  }

  // The known members of an object.
  json Take(const json& from, const std::vector<Field>& fields, const std::string& place) const {
    if (!from.is_object()) Fail(place, "an object");
    json out = json::object();
    for (const Field& field : fields) {
      const auto it = from.find(field.key);
      if (it != from.end()) {
        CheckValue(*it, field, place + "." + field.key);
        out[field.key] = *it;
      } else if (field.required) {
        Fail(place, fmt::format("the member \"{}\"", field.key));
      }
    }
    return out;
  }

  void CheckValue(const json& value, const Field& field, const std::string& place) const {
    switch (field.kind) {
      case Kind::kText:
        if (!value.is_string()) Fail(place, "a string");
        break;
      case Kind::kFlag:
        if (!value.is_boolean()) Fail(place, "true or false");
        break;
      case Kind::kCount:
        CheckCount(value, place);
        break;
      case Kind::kIndex:
        CheckIndex(value, SizeOf(field.of), field.of, place);
        break;
      case Kind::kIndices:
        if (!value.is_array() || (value.empty() && field.required)) Fail(place, "indices");
        for (const json& index : value) CheckIndex(index, SizeOf(field.of), field.of, place);
        break;
      case Kind::kNumbers:
        if (!value.is_array() || value.size() != field.size) {
          Fail(place, fmt::format("{} numbers", field.size));
        }
        for (const json& number : value) {
          if (!number.is_number() || !std::isfinite(number.get<double>())) {
            Fail(place, fmt::format("{} finite numbers", field.size));
          }
        }
        break;
      case Kind::kObject:
        if (!value.is_object()) Fail(place, "an object");
        break;
      case Kind::kArray:
        if (!value.is_array()) Fail(place, "an array");
        break;
    }
  }

  // Small enough for every type that it goes through.
  void CheckCount(const json& value, const std::string& place) const {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > INT32_MAX) {
      Fail(place, "a whole number from 0 to 2147483647");
    }
  }

  void CheckIndex(const json& value, size_t size, const std::string& of,
                  const std::string& place) const {
    CheckCount(value, place);
    if (value.get<std::uint64_t>() >= size) {
      Fail(place,
           fmt::format("an index of one of {} {}, found {}", size, of, value.get<std::uint64_t>()));
    }
  }

  json CheckedAnimation(size_t i) const {
    const std::string place = fmt::format("animations[{}]", i);
    json out = Take(document_["animations"][i], kAnimation, place);
    for (size_t s = 0; s < out["samplers"].size(); ++s) {
      json& sampler = out["samplers"][s];
      sampler = Take(sampler, kSampler, fmt::format("{}.samplers[{}]", place, s));
    }
    for (size_t c = 0; c < out["channels"].size(); ++c) {
      const std::string at = fmt::format("{}.channels[{}]", place, c);
      json& channel = out["channels"][c];
      channel = Take(channel, kChannel, at);
      CheckIndex(channel["sampler"], out["samplers"].size(), "samplers", at + ".sampler");
      channel["target"] = Take(channel["target"], kTarget, at + ".target");
    }
    return out;
  }

  // What skinning needs of a mesh: positions, joints and weights.
  json CheckedMesh(size_t i) const {
    const std::string place = fmt::format("meshes[{}]", i);
    const json mesh = Take(document_["meshes"][i], {{"primitives", Kind::kArray, true}}, place);
    json out = {{"primitives", json::array()}};
    for (size_t p = 0; p < mesh["primitives"].size(); ++p) {
      const std::string at = fmt::format("{}.primitives[{}]", place, p);
      const json primitive = Take(mesh["primitives"][p], {{"attributes", Kind::kObject, true}}, at);
      json attributes = json::object();
      for (const auto& [key, accessor] : primitive["attributes"].items()) {
        if (key != "POSITION" && !key.starts_with("JOINTS_") && !key.starts_with("WEIGHTS_")) {
          continue;
        }
        CheckIndex(accessor, SizeOf("accessors"), "accessors", at + "." + Printable(key));
        attributes[key] = accessor;
      }
      out["primitives"].push_back({{"attributes", attributes}});
    }
    return out;
  }

  const json& document_;
  const std::string& name_;
};

}  // namespace

json CheckedGltf(const json& document, const std::string& name) {
  return Checker(document, name).Checked();
}

}  // namespace retarget::io
