// One figure of scene.glb before it is glTF: its tree of nodes, and its capsules as a skin.
#pragma once

#include <string>
#include <vector>

#include "io/render/capsule_mesh.h"
#include "io/scene/scene_glb.h"
#include "model/body/pose.h"

namespace retarget::io {

// The glTF nodes of one figure: first the nodes of the body in their order, then the extra joints.
struct FigureTree {
  std::vector<std::string> name;  // [nodes] as in the file
  std::vector<int> parent;        // [nodes] -1 for the root
  std::vector<Vec3> translation;  // [nodes] in the parent's frame, rest pose (m)
  std::vector<int> carrier;       // [links] the node that carries the link
};
FigureTree PlanTree(const SceneFigure& figure, const Vec3& root_position);

// The skin of one figure in its bind pose.
struct FigureMesh {
  TriangleMesh triangles;
  std::vector<int> link;  // [vertices] the link each vertex is rigid in
};
FigureMesh BuildMesh(const Body& body, const PosedBody& rest);

}  // namespace retarget::io
