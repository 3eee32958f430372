// CertificateDiff of tools/proof/certificate.h.
#include <fmt/format.h>

#include "tools/proof/certificate.h"

namespace retarget::proof {
namespace {

std::string Written(const Json& value) {
  if (value.is_null()) return "none";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  return value.dump();
}

Json At(const Json& json, const char* pointer) {
  const Json::json_pointer at(pointer);
  return json.contains(at) ? json.at(at) : Json(nullptr);
}

const Json* Named(const Json& list, const Json& name) {
  for (const Json& one : list) {
    if (one.contains("name") && one["name"] == name) return &one;
  }
  return nullptr;
}

void CompareStatements(const Json& a, const Json& b, std::vector<std::string>* out) {
  const Json of_a = At(a, "/statements"), of_b = At(b, "/statements");
  for (const Json& s : of_a) {
    const Json* other = Named(of_b, s["name"]);
    if (!other) {
      out->push_back(fmt::format("{}: in the first alone", Written(s["name"])));
      continue;
    }
    for (const char* key : {"/limit", "/proved", "/bound", "/value"}) {
      const Json x = At(s, key), y = At(*other, key);
      if (Written(x) == Written(y)) continue;
      out->push_back(
          fmt::format("{}: {} {} -> {}", Written(s["name"]), key + 1, Written(x), Written(y)));
    }
  }
  for (const Json& s : of_b) {
    if (!Named(of_a, s["name"])) {
      out->push_back(fmt::format("{}: in the second alone", Written(s["name"])));
    }
  }
}

std::string TagText(const Json& tag) {
  return fmt::format("a ({}, {}) x b ({}, {}) {}", Written(At(tag, "/a/0")),
                     Written(At(tag, "/a/1")), Written(At(tag, "/b/0")), Written(At(tag, "/b/1")),
                     At(tag, "/sign") == Json(-1.0) ? "-" : "+");
}

void CompareTopology(const Json& a, const Json& b, std::vector<std::string>* out) {
  const Json tags_a = At(a, "/topology/tags"), tags_b = At(b, "/topology/tags");
  for (size_t k = 0; k < std::max(tags_a.size(), tags_b.size()); ++k) {
    const std::string x = k < tags_a.size() ? TagText(tags_a[k]) : "none";
    const std::string y = k < tags_b.size() ? TagText(tags_b[k]) : "none";
    if (x != y) out->push_back(fmt::format("tag {}: {} -> {}", k + 1, x, y));
  }
}

}  // namespace

std::vector<std::string> CertificateDiff(const Json& a, const Json& b) {
  std::vector<std::string> out;
  const std::pair<const char*, const char*> single[] = {
      {"/proved", "proved"},
      {"/generator", "version"},
      {"/scene/hash", "scene.glb"},
      {"/subject_hash", "bodies, tags, holds and contacts"},
      {"/motion/keys", "keys"},
      {"/motion/to_s", "end (s)"},
      {"/tolerances/length_m", "margin of lengths (m)"},
      {"/tolerances/gli_turns", "margin of GLI (turns)"},
      {"/topology/crossings", "crossings"},
      {"/stretches", "stretches"},
      {"/depth", "halvings"}};
  for (const auto& [pointer, name] : single) {
    const std::string x = Written(At(a, pointer)), y = Written(At(b, pointer));
    if (x != y) out.push_back(fmt::format("{}: {} -> {}", name, x, y));
  }
  CompareTopology(a, b, &out);
  CompareStatements(a, b, &out);
  return out;
}

}  // namespace retarget::proof
