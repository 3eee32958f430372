#include "io/text/json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace retarget::io {
namespace {

using nlohmann::json;
using Kind = DocumentNode::Kind;

constexpr int kDeepest = 24;

DocumentNode NodeOf(const json& value) {
  DocumentNode node;
  if (value.is_object()) {
    node.kind = Kind::kMap;
    for (const auto& item : value.items()) {
      node.children.push_back(NodeOf(item.value()));
      node.children.back().key = item.key();
    }
  } else if (value.is_array()) {
    node.kind = Kind::kList;
    node.children.reserve(value.size());
    for (const json& item : value) node.children.push_back(NodeOf(item));
  } else if (!value.is_null()) {
    node.kind = Kind::kScalar;
    node.quoted = value.is_string();
    node.text = node.quoted ? value.get<std::string>() : value.dump();
  }
  return node;
}

}  // namespace

Document ParseJson(std::string_view text) {
  const auto shallow = [](int depth, json::parse_event_t, json&) {
    if (depth > kDeepest) {
      throw InputError(fmt::format("the message is nested deeper than {} levels", kDeepest));
    }
    return true;
  };
  try {
    return Document(Notation::kJson, "the message",
                    NodeOf(json::parse(text.begin(), text.end(), shallow)));
  } catch (const json::parse_error& error) {
    throw InputError(fmt::format("the message is not JSON (at byte {})", error.byte));
  } catch (const json::exception&) {  // such as 1e999
    throw InputError("the message is not JSON: a number is out of range");
  }
}

std::string JsonText(const std::string& text) { return json(text).dump(-1, ' ', true); }

}  // namespace retarget::io
