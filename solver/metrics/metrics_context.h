// What is measured: a motion that can be looked at between its frames, and what it is measured
// against.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "model/body/contact.h"
#include "model/body/pass_through.h"
#include "solver/problem/scene.h"

namespace retarget::solver {

// One instant of a motion: every node's place (m) and the rotation of the link that carries it.
struct PostureSample {
  NodePositions node;
  std::array<std::vector<Quat>, 2> rotation;
};

// A motion that can be looked at between its frames too, by several threads at once.
struct MotionView {
  int num_frames = 0;
  double fps = 30;
  std::function<void(double frame, PostureSample* sample)> at;
};

// The motion of two clips: linear in the root, spherical-linear in the rotations. The bodies and
// clips must outlive the view.
MotionView ViewOf(const std::array<Body, 2>& body, const std::array<Clip, 2>& clips);

// Node places of every frame.
std::vector<NodePositions> NodesOf(const MotionView& motion);

// What is measured against: tags, contacts, holds and bodies of the scene.
struct MetricsContext {
  std::array<Body, 2> body;                   // tree and radii
  std::array<std::vector<double>, 2> length;  // of the segment that ends at each node (m)
  std::vector<TangleTarget> tangles;
  std::vector<Hold> holds;
  std::array<std::vector<Contact>, 2> contacts;
  std::vector<HandContact> hand_contacts = {};
  std::array<bool, 2> carried = {};  // the template lets none of its feet stand
};
MetricsContext MetricsContextOf(const Scene& scene);

}  // namespace retarget::solver
