// Distances, speeds and GLI of the second checker, written apart from those of the prover. Inner
// part of solver/proof/advancement.h.
#pragma once

#include <vector>

#include "model/body/path.h"
#include "solver/proof/velocity_playback.h"

namespace retarget::solver {

struct MovingLine {
  PointState from, to;
};

// Largest relative speed and acceleration of the ends of one against those of the other.
struct Relative {
  double v = 0, a = 0;
};

Relative RelativeOf(const PointState& p, const PointState& q);
Relative RelativeOf(const MovingLine& x, const MovingLine& y);

// Distance of a point to the segment a->b, and of two segments: the four ends against the other
// segment, and the common perpendicular where it meets both (m).
double EndDistance(const Vec3& p, const Vec3& a, const Vec3& b);
double SegmentDistance(const MovingLine& x, const MovingLine& y);

// The time within which v h + a h^2 / 2 stays below the slack, a little short of it.
double StepFor(double slack, const Relative& r);

// GLI as minus the solid angle that the separations of two segments sweep, in two triangles.
double PairGli(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

// The nodes of a path, both ends included.
std::vector<int> PathNodes(const Body& body, const Path& path);

}  // namespace retarget::solver
