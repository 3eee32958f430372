// What reading and writing of template postures share. Inner part of io/template_file.h.
#pragma once

#include <string>
#include <vector>

#include "model/body/body.h"

namespace retarget::io {

inline constexpr int kTemplateFormat = 1;  // version

// Of a point's owner; the index is HoldPoint::figure.
inline const std::vector<std::string>& FigureNames() {
  static const std::vector<std::string> names = {"a", "b", "world"};
  return names;
}

// Every measure with its key, for reading and writing alike.
template <typename SideT, typename Visitor>
void VisitSide(SideT& side, Visitor&& visit) {
  visit("clavicle", side.clavicle);
  visit("clavicle_shoulder", side.clavicle_shoulder);
  visit("shoulder_elbow", side.shoulder_elbow);
  visit("elbow_wrist", side.elbow_wrist);
  visit("wrist_hand", side.wrist_hand);
  visit("hip", side.hip);
  visit("hip_knee", side.hip_knee);
  visit("knee_ankle", side.knee_ankle);
  visit("ankle_toe", side.ankle_toe);
}

template <typename MeasuresT, typename Visitor>
void VisitTrunk(MeasuresT& measures, Visitor&& visit) {
  visit("root_chest", measures.root_chest);
  visit("chest_neck", measures.chest_neck);
  visit("neck_head", measures.neck_head);
  visit("head_top", measures.head_top);
}

inline std::vector<std::string> NodeNames(const Body& body) {
  std::vector<std::string> names;
  for (const Node& node : body.nodes) names.push_back(node.name);
  return names;
}

inline std::vector<std::string> LinkNames(const Body& body) {
  std::vector<std::string> names;
  for (const Link& link : body.links) names.push_back(link.name);
  return names;
}

}  // namespace retarget::io
