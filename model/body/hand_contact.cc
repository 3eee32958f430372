#include "model/body/hand_contact.h"

#include "model/geometry/capsule.h"

namespace retarget {
namespace {

ClosestPoints Closest(const Body& body_1, const std::vector<Vec3>& p, int segment_1,
                      const Body& body_2, const std::vector<Vec3>& q, int segment_2) {
  return ClosestPointsOfSegments(p[body_1.nodes[segment_1].parent], p[segment_1],
                                 q[body_2.nodes[segment_2].parent], q[segment_2]);
}

}  // namespace

std::vector<int> HandNodes(const Body& body) {
  std::vector<int> hands;
  for (const char* name : {"left_hand", "right_hand"}) {
    const int node = body.FindNode(name);
    if (node >= 0) hands.push_back(node);
  }
  return hands;
}

double SurfaceGap(const Body& body_1, const std::vector<Vec3>& p, int segment_1, const Body& body_2,
                  const std::vector<Vec3>& q, int segment_2) {
  return -CapsuleDepth(Closest(body_1, p, segment_1, body_2, q, segment_2),
                       body_1.nodes[segment_1].radius, body_2.nodes[segment_2].radius);
}

void PlaceHandContact(const std::array<Body, 2>& body, const std::array<PosedBody, 2>& posed,
                      HandContact* contact) {
  const int f = contact->figure, g = 1 - f;
  const ClosestPoints closest =
      Closest(body[f], posed[f].node, contact->hand, body[g], posed[g].node, contact->to);
  contact->along = closest.s;
  contact->to_along = closest.t;
}

std::vector<HandContact> FindHandContacts(const std::array<Body, 2>& body,
                                          const std::array<PosedBody, 2>& posed, double reach) {
  std::vector<HandContact> found;
  for (int f = 0; f < 2; ++f) {
    const int g = 1 - f;
    for (const int hand : HandNodes(body[f])) {
      HandContact contact;
      double nearest = reach;
      for (int n = 1; n < body[g].num_nodes(); ++n) {
        const double gap = SurfaceGap(body[f], posed[f].node, hand, body[g], posed[g].node, n);
        if (gap > nearest) continue;
        nearest = gap;
        contact = {f, hand, 0, n, 0};
      }
      if (contact.to == 0) continue;
      PlaceHandContact(body, posed, &contact);
      found.push_back(contact);
    }
  }
  return found;
}

}  // namespace retarget
