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

// A tag with what is asked of it (turns, of s GLI): at least `target`, best `aim`, its value in the
// template.
struct TangleTarget {
  Tag tag;
  double sign = 1;
  double target = 0;
  double aim = 0;
};

// A turn about the vertical through the root, and a horizontal shift.
struct RootShift {
  double yaw = 0;             // rad
  Vec3 shift = Vec3::Zero();  // m
};

struct Scene {
  std::array<Body, 2> body;
  std::array<Clip, 2> source;  // the placed clips; equal numbers of frames
  TemplatePosture posture;     // fitted to these two bodies
  int template_frame = 0;      // the frame that is laid into the template
  std::vector<TangleTarget> tangles;
  std::vector<Hold> holds;
  std::vector<HandContact> hand_contacts;
  std::array<RootReference, 2> root = {RootReference::kOwnClip, RootReference::kOwnClip};
  std::array<std::vector<Contact>, 2> contacts;
  // Turns that the figures' own rigs cannot make, per frame; empty where they can make all.
  std::array<std::vector<std::vector<LockedAxis>>, 2> locked_axes;
  // A source beyond a joint's limit may stay there, and comes near it at no cost; else the limit
  // itself counts (posing).
  bool source_widens_limits = true;
  // Where edits of the roots are counted from, per frame: the placed root, shifted. Empty: the
  // placed root itself. (EditBase)
  std::array<std::vector<RootShift>, 2> base;

  int num_frames() const { return source[0].num_frames(); }
  double fps() const { return source[0].fps; }
  // Coordinates of one frame: those of a, then those of b.
  int num_coordinates() const { return body[0].num_coordinates() + body[1].num_coordinates(); }
  int FirstCoordinate(int figure) const { return figure == 0 ? 0 : body[0].num_coordinates(); }
  RootShift BaseOf(int figure, int t) const {
    return base[figure].empty() ? RootShift{} : base[figure][static_cast<size_t>(t)];
  }
};

// The unknowns. Column t of `edit` is the edit of frame t: per figure the root's translation (m)
// and a rotation vector (rad) per link, R = R_source exp(delta); for the root, both from its base.
// Rotation vectors may be longer than pi: they change from frame to frame without a leap.
// `anchor` holds where each contact stands: column k of [2 x contacts of a, then of b] is its place
// on the floor, x and z (m).
struct Unknowns {
  MatX edit;
  MatX anchor;
};

// Edits that turn the source into `poses`, followed along time from the template's frame outwards;
// contact anchors at their mean places.
Unknowns UnknownsFromPoses(const Scene& scene, const std::array<Clip, 2>& poses);

// The edited motion.
std::array<Clip, 2> EditedClips(const Scene& scene, const Unknowns& unknowns);

// The pose of a figure at frame t with the edit in column t of `edit`.
void EditedPose(const Scene& scene, int figure, int t, const MatX& edit, Pose* pose);
// The other way: sets the coordinates of the figure in column t of `edit`. Rotation vectors are
// those nearest to the ones in column `beside`; the shortest where it is t itself.
void EditOf(const Scene& scene, int figure, int t, const Pose& pose, int beside, MatX* edit);

// The placed root of a figure at frame t with its shift.
Pose ShiftedRoot(const Pose& source, const RootShift& shift);

}  // namespace retarget::solver
