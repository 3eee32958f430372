// Planted feet: when a node of a foot stands on the floor.
#pragma once

#include <vector>

#include "model/body/body.h"
#include "model/body/pose.h"
#include "model/settings.h"

namespace retarget {

// Node `node` is planted from frame `first` to frame `last`, both included.
struct Contact {
  int node = 0;
  int first = 0;
  int last = 0;
};

// Contacts of the nodes `supports` in a clip: slower than settings.speed (central difference) and
// within settings.height of the node's own 5th percentile of height; gaps shorter than max_gap_s
// are closed, then runs shorter than min_length_s dropped. Sorted by node, then by time.
std::vector<Contact> DetectContacts(const Body& body, const Clip& clip,
                                    const std::vector<int>& supports,
                                    const ContactSettings& settings);

// The same of one node's path over the floor; the contacts are of node `node`.
std::vector<Contact> DetectContacts(const std::vector<Vec3>& path, double fps, int node,
                                    const ContactSettings& settings);

// Ankles and toes of a body, by name.
std::vector<int> FootNodes(const Body& body);

}  // namespace retarget
