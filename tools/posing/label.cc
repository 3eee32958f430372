#include "tools/posing/label.h"

#include "tools/posing/operation_table.h"

namespace retarget::posing {
namespace {

template <typename Op>
std::string PlaceOf(const Op& op, const TemplatePosture& posture) {
  if constexpr (requires { op.figure; }) {
    if (op.figure != 0 && op.figure != 1) return "";
    const Body& body = posture.body[op.figure];
    const std::string figure = op.figure == 0 ? "a" : "b";
    if constexpr (requires { op.node; }) {
      if (op.node >= 0 && op.node < body.num_nodes()) {
        return figure + "/" + body.nodes[op.node].name;
      }
    } else if constexpr (requires { op.link; }) {
      if (op.link >= 0 && op.link < body.num_links()) {
        return figure + "/" + body.links[op.link].name;
      }
    }
    return figure;
  }
  return "";
}

}  // namespace

std::string LabelOf(const Operation& operation, const TemplatePosture& posture) {
  const std::string place =
      std::visit([&](const auto& op) { return PlaceOf(op, posture); }, operation);
  return RowOf(operation).label + (place.empty() ? "" : " of " + place);
}

}  // namespace retarget::posing
