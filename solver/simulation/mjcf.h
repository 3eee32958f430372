// The figures as a MuJoCo model, written in MuJoCo's own language (MJCF). Nothing here calls
// MuJoCo.
#pragma once

#include <string>
#include <vector>

#include "model/body/body.h"

namespace retarget::solver {

// How stiff the physics is. Constraints and contacts come back to zero error within about twice
// their time constant (MuJoCo's solref, damping ratio 1); it must be at least two time steps.
struct PhysicsOptions {
  double time_step = 0.004;  // s
  double gravity = 9.81;     // m/s^2, downwards
  double armature = 0.02;    // kg m^2, added to the inertia of every joint
  double friction = 1;
  double contact_time = 0.01;  // s
  double tie_time = 0.01;      // s
  bool floor = true;
  bool collide = true;  // figures with each other; a figure never collides with itself
};

// A tie holds a point of a link on a point of another link, or of the world; with `rotation` also
// the relative turn of the two. Equality constraints are declared with the model and can be
// fastened and let go.
struct EqualityConstraint {
  int figure = 0, link = 0;
  int to_figure = -1, to_link = 0;  // -1: the world
  bool rotation = false;
};

struct PhysicsFigure {
  Body body;
  // Taken off implicitly, so that stiff control stays stable: of every link's joint, [0] the root's
  // turn (N m s/rad), and of the root's place over the floor and its height (N s/m).
  std::vector<double> damping;
  double root_damping = 0, root_height_damping = 0;
};

// Names in the model: body "<figure>/<link>", joint the same, geom "<figure>/<node>" by the outer
// node of its segment, tie "tie<k>".
std::string LinkName(int figure, int link);
std::string SegmentName(int figure, int node);
std::string TieName(int tie);

// Contact is possible where contype of one geom meets conaffinity of the other: the floor's bit
// with all, figure 0 with figure 1.
inline constexpr int kFloorBit = 4;

// A free joint for each root and a ball joint for every other link, in links' order; one capsule
// per segment with the segment's mass, rigid in the link that carries the segment's outer node.
std::string FormatMjcf(const std::vector<PhysicsFigure>& figures,
                       const std::vector<EqualityConstraint>& ties, const PhysicsOptions& options);

}  // namespace retarget::solver
