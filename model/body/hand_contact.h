// Hands that touch: what a hand lies on, and how far from it.
#pragma once

#include <array>
#include <vector>

#include "model/body/body.h"
#include "model/body/pose.h"

namespace retarget {

// The capsule of a hand against the capsule of a segment of the partner (a limb, the trunk, the
// head). Where along both axes they touch are shares from each segment's inner node.
struct HandContact {
  int figure = 0;      // whose hand
  int hand = 0;        // its segment's outer node: left_hand or right_hand
  double along = 0.5;  // of the hand's segment
  int to = 0;          // outer node of the partner's segment
  double to_along = 0.5;
};

// The nodes that end the segments of hands.
std::vector<int> HandNodes(const Body& body);

// The contacts of a posture: each hand with the nearest segment of the partner, where the gap
// between their surfaces is no more than `reach` (m); the nearest may overlap.
std::vector<HandContact> FindHandContacts(const std::array<Body, 2>& body,
                                          const std::array<PosedBody, 2>& posed, double reach);

// Sets where along both axes a contact touches from the posture.
void PlaceHandContact(const std::array<Body, 2>& body, const std::array<PosedBody, 2>& posed,
                      HandContact* contact);

// Gap between the surfaces of two segments' capsules, named by their outer nodes; negative: overlap
// (m). `p` and `q` are the nodes' places.
double SurfaceGap(const Body& body_1, const std::vector<Vec3>& p, int segment_1, const Body& body_2,
                  const std::vector<Vec3>& q, int segment_2);

}  // namespace retarget
