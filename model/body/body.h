// The body: a tree of rigid links that turn about joint centres, and of nodes carried by them.
//
// A *link* is what a joint drives: link 0 is the root body (position and rotation), every other
// link turns about its joint centre, a point fixed in its parent link (a ball joint each).
// A *node* is a point fixed in a link; a *segment* is the straight line from a node's parent node
// to the node, and is named by its outer node. All of it is data: a body with fingers or a longer
// spine is a longer table (Ho and Komura 2007, section 4.2), and no other code knows.
//
// Canonical rest pose: every link rotation is the identity; a T-pose that faces +Z, left is +X,
// palms down, feet along +Z.
#pragma once

#include <string>
#include <vector>

#include "model/body/joint_limit.h"
#include "model/geometry/types.h"

namespace retarget {

struct Link {
  std::string name;            // "root", "waist", "left_elbow", ...
  int parent = -1;             // link, always before this one; -1 for the root
  Vec3 centre = Vec3::Zero();  // joint centre in the parent's frame (m)
  JointLimit limit;
  bool locked = false;  // the rig has no joint here: it keeps its captured rotation
};

struct Node {
  std::string name;            // "left_wrist", ...
  int parent = -1;             // node, always before this one; -1 for the root node
  int link = 0;                // the link that carries it
  Vec3 offset = Vec3::Zero();  // in that link's frame (m)
  double radius = 0;           // of the capsule round the segment that ends here (m); 0 at the root
  double mass = 0;             // of that segment (kg)
};

struct Body {
  double stature = 0;  // m
  std::vector<Link> links;
  std::vector<Node> nodes;

  int num_links() const { return static_cast<int>(links.size()); }
  int num_nodes() const { return static_cast<int>(nodes.size()); }
  // Coordinates of a pose edit: root translation, then a rotation vector per link.
  int num_coordinates() const { return 3 + 3 * num_links(); }

  // Index by name, -1 where there is none.
  int FindLink(const std::string& name) const;
  int FindNode(const std::string& name) const;
  // Length of the segment that ends at `node`, in the rest pose (m).
  double SegmentLength(int node) const;
};

// Scales a body to another stature: all lengths and radii by the ratio, masses by its cube.
Body ScaledTo(const Body& body, double stature);

// Bone lengths and the few points that are not on a bone axis, all in m. What a clip's skeleton
// says about its owner; see StandardBody.
struct BodyMeasures {
  double root_chest = 0, chest_neck = 0, neck_head = 0, head_top = 0;
  struct Side {
    Vec3 clavicle = Vec3::Zero();  // clavicle's joint centre in the chest link's frame, from the
                                   // chest joint
    double clavicle_shoulder = 0, shoulder_elbow = 0, elbow_wrist = 0, wrist_hand = 0;
    Vec3 hip = Vec3::Zero();  // in the root link's frame
    double hip_knee = 0, knee_ankle = 0, ankle_toe = 0;
  };
  Side left, right;
};

// Measures of an average adult of the given stature (m). Drillis and Contini 1966, as printed in
// Winter, "Biomechanics and Motor Control of Human Movement", 4th ed. 2009, Fig. 4.1.
BodyMeasures AverageMeasures(double stature);

// The 20-segment body of Ho and Komura 2007: 21 nodes, 18 ball joints, 60 coordinates. Radii and
// masses come from anthropometric tables scaled by the stature that follows from the lengths.
Body StandardBody(const BodyMeasures& measures);

// Ground to vertex of the standing body (m): the canonical rest pose, with the ankle at the
// tabulated height over the floor.
double StatureOf(const BodyMeasures& measures);

// Height of the ankle over the floor, as a share of the stature (Drillis and Contini 1966).
inline constexpr double kAnkleHeight = 0.039;
// Head joint to vertex, as a share of the stature, for rigs that do not say (ibid.).
inline constexpr double kHeadLength = 0.130;
// Wrist to the base of the middle finger, as a share of the stature (half of the hand, ibid.).
inline constexpr double kHandLength = 0.054;
// Ankle to toe joint, for rigs without one (ibid., three quarters of the foot less the heel).
inline constexpr double kFootLength = 0.100;

}  // namespace retarget
