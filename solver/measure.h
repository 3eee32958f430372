// The field's metrics of a two-figure motion, from geometry alone (definitions: docs/metrics.md).
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "model/contact.h"
#include "model/settings.h"
#include "solver/guard.h"
#include "solver/scene.h"

namespace retarget {

// One instant of a motion: every node's place (m) and the rotation of the link that carries it.
struct PostureSample {
  NodePositions node;
  std::array<std::vector<Quat>, 2> rotation;
};

// A motion that can be looked at between its frames too.
struct MotionView {
  int num_frames = 0;
  double fps = 30;
  std::function<void(double frame, PostureSample* sample)> at;
};

// The motion of two clips: linear in the root, spherical-linear in the rotations. The bodies and
// clips must outlive the view.
MotionView ViewOf(const std::array<Body, 2>& body, const std::array<Clip, 2>& clips);

// What is measured against: tags, contacts, holds and bodies of the scene.
struct MeasureSubject {
  std::array<Body, 2> body;                   // tree and radii
  std::array<std::vector<double>, 2> length;  // of the segment that ends at each node (m)
  std::vector<HeldTangle> tangles;
  std::vector<Hold> holds;
  std::array<std::vector<Contact>, 2> contacts;
};
MeasureSubject SubjectOf(const Scene& scene);

struct TangleMetrics {
  double min_signed_gli = 0;          // over the frames (turns)
  double min_signed_gli_between = 0;  // the same at 4x sub-sampling
  int frames_below_half = 0;
  int worst_frame = 0;
};

struct PassThrough {
  int frame = 0;  // the jump lies between this frame and the next
  int node_a = 0, node_b = 0;
};

struct FigureMetrics {
  double self_penetration_m = 0;
  double floor_m = 0;
  double foot_drift_m = 0;
  int foot_drift_frame = 0;
  double foot_speed_max = 0;               // m/s, inside contacts
  double foot_speed_over_1cm_percent = 0;  // of stance frames
  double pose_error_cm = 0;                // mean over nodes of no tagged path
  double joint_edit_deg = 0;               // mean over nodes' links and frames
  double jerk = 0;                         // m/s^3
  double jerk_ratio_own = 1;               // to its own source
  double jerk_ratio_larger = 1;            // to the larger of the two sources
  double length_error_percent = 0;         // of segments, neck-shoulder exempt
  std::vector<double> path_m;              // per node, relative to the root
};

struct Metrics {
  std::vector<TangleMetrics> tangles;
  double tangle_kept_percent = 100;  // frames in which every tag is above one half
  double smallest_gli = 0;           // over all tags and frames; 0 without tags
  double smallest_gli_between = 0;
  std::vector<PassThrough> pass_throughs;
  double penetration_m = 0;          // largest, frames
  double penetration_between_m = 0;  // largest, 4x
  int penetration_frame = 0;
  int penetration_node_a = 0, penetration_node_b = 0;
  double penetration_over_1cm_percent = 0;  // of frames
  std::vector<double> hold_m;               // largest error per hold
  std::vector<int> hold_frame;
  std::array<FigureMetrics, 2> figure;
};

// Measures `motion`; `source` (the placed, unedited clips) is what edits and jerk are compared
// with.
Metrics Measure(const MeasureSubject& subject, const MotionView& motion, const MotionView& source);

// A requirement and whether it is met; `where` names frame and limb of the worst.
struct RequirementCheck {
  std::string name;
  double value = 0, limit = 0;
  std::string unit;
  bool met = true;
  std::string where;
};
bool AllMet(const std::vector<RequirementCheck>& checks);
std::vector<RequirementCheck> CheckRequirements(const MeasureSubject& subject,
                                                const Metrics& metrics,
                                                const Requirements& requirements);

}  // namespace retarget
