// The ways of free feet between footprints, from the capture: what the term foot_swing holds an
// edited foot to (docs/theory.md, "Contacts and foot anchors").
#pragma once

#include <vector>

#include "solver/problem/scene.h"

namespace retarget::solver {

// Where a node of a foot is at frame t, from the anchors of the footprints that the foot left last
// and reaches next:
//   q = (1 - u) (a + R way) + u (a' + R way_to_next),  q_y = height + lift * share(D),
//   D = |a' - a - R stride|
// R is the turn about the vertical of the figure's edit. While another node of the foot stands
// there is one footprint only (`to` is -1 and u 0): the node's own, or that of the other.
struct FootPathPoint {
  int t = 0;
  int node = 0;
  int to = -1;      // anchor a'
  double u = 0;     // from 0 to 1 with least jerk while the whole foot is free
  double lift = 0;  // m, at most
  double height = 0;
  Vec3 way = Vec3::Zero(), way_to_next = Vec3::Zero();  // over the floor
  Vec3 stride = Vec3::Zero();                           // from footprint to footprint
};

// Per anchor a, sorted by t. A foot that is free for more than kLongestStep is left out, and so is
// what lies before its first and after its last footprint.
std::vector<std::vector<FootPathPoint>> FootPaths(const Scene& scene);
inline constexpr double kLongestStep = 4;  // s

// Where a foot stands: mean height of a contact's node over it, in the source (m).
double HeightOf(const std::vector<std::vector<Vec3>>& node, const Contact& contact);

// Node places of a figure's source, per frame.
std::vector<std::vector<Vec3>> SourceNodes(const Scene& scene, int figure);

}  // namespace retarget::solver
