#include "io/scene/scene_figure.h"

#include <cassert>

namespace retarget::io {
namespace {

// A node of the body that stands at the joint centre of link `l` and is still free, or -1.
int NodeAtJoint(const Body& body, int l, const std::vector<bool>& taken) {
  const Link& link = body.links[l];
  for (int n = 0; n < body.num_nodes(); ++n) {
    const Node& node = body.nodes[n];
    if (node.parent < 0 || taken[n] || node.link != link.parent) continue;
    if ((node.offset - link.centre).norm() <= 1e-12) return n;
  }
  return -1;
}

}  // namespace

FigureTree PlanTree(const SceneFigure& figure, const Vec3& root_position) {
  const Body& body = *figure.body;
  assert(body.nodes[0].parent < 0 && body.nodes[0].link == 0 && body.nodes[0].offset.isZero());
  FigureTree tree;
  for (const Node& node : body.nodes) {
    tree.name.push_back(figure.name + "/" + node.name);
    tree.translation.push_back(node.offset);
  }
  tree.translation[0] = root_position;
  tree.parent.assign(body.nodes.size(), -1);
  tree.carrier.assign(body.links.size(), 0);

  std::vector<bool> taken(body.nodes.size(), false);
  for (int l = 1; l < body.num_links(); ++l) {
    const int node = NodeAtJoint(body, l, taken);
    if (node >= 0) {
      taken[node] = true;
      tree.carrier[l] = node;
      continue;
    }
    tree.carrier[l] = static_cast<int>(tree.name.size());
    tree.name.push_back(figure.name + "/joint/" + body.links[l].name);
    tree.parent.push_back(tree.carrier[body.links[l].parent]);
    tree.translation.push_back(body.links[l].centre);
  }
  for (int n = 1; n < body.num_nodes(); ++n) tree.parent[n] = tree.carrier[body.nodes[n].link];
  return tree;
}

FigureMesh BuildMesh(const Body& body, const PosedBody& rest) {
  FigureMesh mesh;
  const auto add = [&](const Vec3& a, const Vec3& b, double radius, int link) {
    AppendCapsule(a, b, radius, &mesh.triangles);
    mesh.link.resize(mesh.triangles.position.size(), link);
  };
  for (int n = 1; n < body.num_nodes(); ++n) {
    const Node& node = body.nodes[n];
    add(rest.node[node.parent], rest.node[n], node.radius, node.link);
  }
  if (const auto nose = NoseOf(body)) {
    const Vec3& centre = rest.centre[nose->link];
    add(centre + nose->a, centre + nose->b, nose->radius, nose->link);
  }
  return mesh;
}

}  // namespace retarget::io
