// What the spacetime problem is about: two bodies, the motions they are to keep, and what ties
// them.
#pragma once

#include <array>
#include <vector>

#include "model/body/contact.h"
#include "model/body/pose.h"
#include "model/body/tangle.h"
#include "model/body/template_posture.h"

namespace retarget::solver {

// A tag with the value that its residual aims for (turns, of s GLI).
struct TangleTarget {
  Tag tag;
  double sign = 1;
  double target = 0;
};

struct Scene {
  std::array<Body, 2> body;
  std::array<Clip, 2> source;  // the placed clips; equal numbers of frames
  TemplatePosture posture;     // fitted to these two bodies
  int template_frame = 0;      // the frame that is laid into the template
  std::vector<TangleTarget> tangles;
  std::vector<Hold> holds;
  std::array<RootReference, 2> root = {RootReference::kOwnClip, RootReference::kOwnClip};
  std::array<std::vector<Contact>, 2> contacts;
  // Turns that the figures' own rigs cannot make, per frame; empty where they can make all.
  std::array<std::vector<std::vector<LockedAxis>>, 2> locked_axes;

  int num_frames() const { return source[0].num_frames(); }
  double fps() const { return source[0].fps; }
  // Coordinates of one frame: those of a, then those of b.
  int num_coordinates() const { return body[0].num_coordinates() + body[1].num_coordinates(); }
  int FirstCoordinate(int figure) const { return figure == 0 ? 0 : body[0].num_coordinates(); }
};

// The unknowns. Column t of `edit` is the edit of frame t: per figure the root's translation (m)
// and a rotation vector (rad) per link, R = R_source exp(delta). `anchor` holds where each contact
// stands: column k of [2 x contacts of a, then of b] is its place on the floor, x and z (m).
struct Unknowns {
  MatX edit;
  MatX anchor;
};

// Edits that turn the source into `poses`; contact anchors at their mean places.
Unknowns UnknownsFromPoses(const Scene& scene, const std::array<Clip, 2>& poses);

// The edited motion.
std::array<Clip, 2> EditedClips(const Scene& scene, const Unknowns& unknowns);

// The pose of one figure at one frame; `x` are the frame's coordinates of that figure.
void EditedPose(const Pose& source, const double* x, Pose* pose);
// The other way: the coordinates that turn `source` into `pose`.
void EditOf(const Pose& source, const Pose& pose, double* x);

}  // namespace retarget::solver
