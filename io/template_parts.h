// Parts of a template posture that its file and the messages of the studio's page have in common.
// All throw InputError.
#pragma once

#include <array>
#include <optional>

#include "io/text/document.h"
#include "model/body/template_posture.h"

namespace retarget::io {

inline constexpr double kMaxPosition = 1000;  // m, of positions

int ReadNode(const Value& value, const Body& body);

// Two different nodes in any order; the path is from the lower one.
Path ReadPath(const Value& value, const Body& body);
// {a: [NODE, NODE], b: [NODE, NODE], from, to}; times in s.
TangleRequest ReadTangle(const Value& value, const std::array<Body, 2>& body);

// A hold as it is asked for. `to` without an offset (or a place in the world) is where `from` is.
struct HoldRequest {
  HoldPoint from;
  int to_figure = 1, to_node = 0;
  std::optional<Vec3> to_offset = {};
  bool rotation = false;
};
// Of the keys `from`, `to` and `rotation` of a map. A place in the world is its `position` in a
// file, its `offset` in a message.
HoldRequest ReadHold(const Value& map, const std::array<Body, 2>& body);
// The hold of figures that are posed so; its relative rotation is theirs.
Hold MakeHold(const HoldRequest& request, const std::array<Body, 2>& body,
              const std::array<PosedBody, 2>& posed);

// {from: {figure, node: HAND, along}, to: {figure, node, along}}: a hand on a segment of the
// partner. Without `along` (shares, 0 to 1) where the two are nearest in the posture.
HandContact ReadHandContact(const Value& map, const std::array<Body, 2>& body,
                            const std::array<PosedBody, 2>& posed);

TemplatePhoto ReadPhoto(const Value& value, size_t longest_name);
TemplateCamera ReadCamera(const Value& value);

}  // namespace retarget::io
