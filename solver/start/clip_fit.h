// How well clips fit the figures of a template, told before anything is solved.
//
// Two postures are compared apart from where they stand, which way they face and how large they
// are: joint rotations of both on one body (the template's), root on root, the turn about the
// vertical that fits best taken out. What is left is a distance of nodes.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/body/pose.h"
#include "model/body/tangle.h"
#include "model/body/template_posture.h"

namespace retarget::solver {

// Root mean square distances of nodes, as shares of the stature (no unit).
struct PostureDistance {
  double whole = 0;     // over all nodes but the root's
  double involved = 0;  // over those of tagged paths and holds; `whole` where there is none
  double stance = 0;    // over trunk, head and legs
  double yaw = 0;       // rad, the turn of the pose that fits best

  // Both alike: what is wound must be as in the template, and the rest must not be forgotten.
  double value() const;
};

// A figure of a template, and the nodes of it that tags and holds are about.
class FigurePosture {
 public:
  FigurePosture(const TemplatePosture& posture, int figure, const std::vector<Tag>& tags);

  // Of a pose of a body with the same links, of any lengths.
  PostureDistance DistanceOf(const Pose& pose) const;

 private:
  Body body_;
  std::vector<Vec3> nodes_;           // from the root (m)
  std::vector<char> involved_, arm_;  // per node
};

// The frame of a clip that is nearest to a figure.
struct Instant {
  int frame = 0;
  PostureDistance distance;
};
Instant BestInstant(const FigurePosture& figure, const Clip& clip);

// Clips against figures at the instant that is laid into the template.
struct ClipFit {
  // [clip][figure]
  std::array<std::array<PostureDistance, 2>, 2> at_template;

  // Clip a as figure a and clip b as figure b, or the other way round: root mean square of both.
  double as_given() const;
  double swapped() const;
  // The other way round is clearly better: `swapped` is less than kClearlyBetter of `as_given`, by
  // more than captured postures differ from posed ones anyway.
  bool swapped_fits_better() const;
  // The clip stands, sits or lies otherwise than the figure. Arms do not count: that they come to
  // lie round the partner is what the solve is for.
  bool stands_otherwise(int clip, int figure) const;
};

// Share of a distance under which another one is clearly better.
inline constexpr double kClearlyBetter = 0.75;
// Differences of distances (shares of the stature) that say nothing.
inline constexpr double kPostureNoise = 0.01;
// Distance of trunk, head and legs (share of the stature) from which on a posture is another one: a
// long stride against standing is 0.15, sitting against standing 0.23, lying 0.4.
inline constexpr double kOtherStance = 0.18;

ClipFit FitOf(const TemplatePosture& posture, const std::vector<Tag>& tags,
              const std::array<Clip, 2>& clips, int template_frame);

// Whether two clips are one motion: the same joint rotations in every frame (within a degree in the
// mean, which rounding and resampling need), apart from where and which way the figures go.
bool IsSameMotion(const Clip& a, const Clip& b);

// A sentence for each thing that a user should know before the solve.
std::vector<std::string> WarningsOf(const ClipFit& fit, bool same_motion);

}  // namespace retarget::solver
