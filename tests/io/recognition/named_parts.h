// The parts of a joint map by the names that the tests' tables have for them.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "model/rig/rig.h"

namespace retarget::io {

// Calls visit("left_elbow", joint) for root, head, first neck and the limbs without toes; the joint
// is -1 where there is none.
inline void VisitNamedParts(const JointMap& map,
                            const std::function<void(const std::string&, int)>& visit) {
  visit("root", map.root);
  visit("head", map.head);
  visit("neck", map.neck.empty() ? -1 : map.neck.front());
  for (const auto& [prefix, side] : {std::pair("left_", &map.left), {"right_", &map.right}}) {
    const std::string p = prefix;
    visit(p + "clavicle", side->clavicle);
    visit(p + "shoulder", side->shoulder);
    visit(p + "elbow", side->elbow);
    visit(p + "wrist", side->wrist);
    visit(p + "hip", side->hip);
    visit(p + "knee", side->knee);
    visit(p + "ankle", side->ankle);
  }
}

}  // namespace retarget::io
