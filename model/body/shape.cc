#include "model/body/shape.h"

#include <algorithm>

namespace retarget {

std::vector<double> NodeRadii(const Body& body) {
  std::vector<double> radius(body.nodes.size(), 0);
  for (int n = 1; n < body.num_nodes(); ++n) {
    const int parent = body.nodes[n].parent;
    radius[n] = std::max(radius[n], body.nodes[n].radius);
    radius[parent] = std::max(radius[parent], body.nodes[n].radius);
  }
  return radius;
}

std::vector<std::pair<int, int>> SelfPairs(const Body& body) {
  const auto touch = [&](int i, int j) {  // segments that share a node
    const int pi = body.nodes[i].parent, pj = body.nodes[j].parent;
    return i == pj || j == pi || pi == pj;
  };
  std::vector<std::pair<int, int>> pairs;
  for (int i = 1; i < body.num_nodes(); ++i) {
    for (int j = i + 1; j < body.num_nodes(); ++j) {
      bool near = touch(i, j);
      for (int k = 1; k < body.num_nodes() && !near; ++k) near = touch(i, k) && touch(k, j);
      if (!near) pairs.emplace_back(i, j);
    }
  }
  return pairs;
}

}  // namespace retarget
