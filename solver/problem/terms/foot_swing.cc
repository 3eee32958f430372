#include "solver/problem/terms/foot_swing.h"

#include <algorithm>
#include <cmath>

namespace retarget::solver {
namespace {

// Height over the contact's (m) from which a foot has left the floor.
constexpr double kHigh = 0.08;
// A captured height is low under this, and high over kHigh.
constexpr double kLow = 0.02;
// Times from the contact's end (s), likewise: a step's beginning, half a slow step.
constexpr double kSoon = 0.1, kLate = 0.4;
// A foot that does not leave the floor is guided on, for so long (s).
constexpr double kLongest = 2;
// A foot that is further off its path (m) is pulled no more: it is led away, and held back it would
// be flung after its body once it is let go.
constexpr double kMostPull = 0.1;
constexpr double kLeastWeight = 1e-3;  // less guides nothing
// The height itself is asked for so much less: a foot may always step higher.
constexpr double kHeightShare = 0.2;

// 1 up to `full`, 0 from `none` on, smooth between.
double Fade(double x, double full, double none) {
  const double u = std::clamp((x - full) / (none - full), 0.0, 1.0);
  return 1 - u * u * (3 - 2 * u);
}

// g: falls at once as the foot rises, so that lifting it always helps.
struct Nearness {
  double value, slope;
  explicit Nearness(double height) {
    const double u = std::clamp(height / kHigh, 0.0, 1.0);
    value = (1 - u) * (1 - u);
    slope = height > 0 ? -2 * (1 - u) / kHigh : 0;
  }
};

// Heading of a rotation: the twist of its swing-twist decomposition about the vertical, as half
// angle (c, s), and the derivative of the angle by a turn d omega in world axes,
// d q = 1/2 omega q.
struct Heading {
  double cosine = 1, sine = 0;
  Vec3 gradient = Vec3::UnitY();
};

Heading HeadingOf(const Quat& q) {
  const double w = q.w(), y = q.y(), square = w * w + y * y;
  if (square < 1e-12) return {};  // upside down: there is no heading, and the fade has ended
  Heading out;
  out.cosine = (w * w - y * y) / square;
  out.sine = 2 * w * y / square;
  out.gradient = (w * w * Vec3::UnitY() + w * q.vec().cross(Vec3::UnitY()) + y * q.vec()) / square;
  return out;
}

}  // namespace

Contact FootSwing::Reach(const Scene& scene, int figure, const Contact& contact) {
  const int most = static_cast<int>(std::ceil(kLongest * scene.fps()));
  Contact reach = {contact.node, std::max(0, contact.first - most),
                   std::min(scene.num_frames() - 1, contact.last + most)};
  for (const Contact& other : scene.contacts[figure]) {  // not into the node's other contacts
    if (other.node != contact.node) continue;
    if (other.last < contact.first) reach.first = std::max(reach.first, other.last + 1);
    if (other.first > contact.last) reach.last = std::min(reach.last, other.first - 1);
  }
  return reach;
}

FootSwing::FootSwing(const Scene& scene) {
  for (int f = 0; f < 2; ++f) {
    if (scene.contacts[f].empty()) continue;
    std::vector<std::vector<Vec3>> node;
    for (const Pose& pose : scene.source[f].frames) {
      node.push_back(PoseBody(scene.body[f], pose).node);
    }
    for (const Contact& contact : scene.contacts[f]) {
      const int n = contact.node;
      Foot foot{f, n, 0, {}};
      for (int t = contact.first; t <= contact.last; ++t) foot.height += node[t][n].y();
      foot.height /= contact.last - contact.first + 1;
      const Contact reach = Reach(scene, f, contact);
      double highest = 0;  // since the contact's end (m over its height)
      const auto guide = [&](int t, int edge) {
        const double time = std::abs(t - edge) / scene.fps();
        highest = std::max(highest, node[t][n].y() - foot.height);
        const double weight = std::max(Fade(time, kSoon, kLate), Fade(highest, kLow, kHigh));
        if (weight < kLeastWeight) return false;
        foot.guided.push_back({t, weight, node[t][n] - node[edge][n]});
        return true;
      };
      for (int t = contact.first - 1; t >= reach.first && guide(t, contact.first);) --t;
      std::reverse(foot.guided.begin(), foot.guided.end());
      highest = 0;
      for (int t = contact.last + 1; t <= reach.last && guide(t, contact.last);) ++t;
      feet_.push_back(std::move(foot));
    }
  }
}

int FootSwing::row_slots(const Frame& frame) const {
  int rows = 0;
  for (const Foot& foot : feet_) {
    for (const Guided& g : foot.guided) rows += g.t == frame.t ? 3 : 0;
  }
  return rows;
}

void FootSwing::EvaluatePart(const Frame& frame, int anchor, Rows* rows) const {
  const Foot& foot = feet_[static_cast<size_t>(anchor)];
  const auto guided = std::lower_bound(foot.guided.begin(), foot.guided.end(), frame.t,
                                       [](const Guided& g, int t) { return g.t < t; });
  if (guided == foot.guided.end() || guided->t != frame.t) return;
  const int f = foot.figure;
  const Quat turned =
      frame.pose[f].rotation[0] * frame.scene->source[f].frames[frame.t].rotation[0].conjugate();
  const Heading heading = HeadingOf(turned);
  const Vec3& d = guided->way;
  const double c = heading.cosine, s = heading.sine, w = guided->weight;
  const Vec3 way(c * d.x() + s * d.z(), d.y(), -s * d.x() + c * d.z());
  const Vec3 way_by_angle(-s * d.x() + c * d.z(), 0, -c * d.x() - s * d.z());
  const auto at = frame.anchor->col(anchor);
  const Vec3& p = frame.posed[f].node[foot.node];
  const Vec3 r = p - Vec3(at[0], foot.height, at[1]) - way;
  const Nearness near(p.y() - foot.height);
  for (const int k : {0, 2}) {
    const double pull = kMostPull * std::tanh(r[k] / kMostPull);
    const double slope = 1 - pull * pull / (kMostPull * kMostPull);
    const int row = rows->Add(w * near.value * pull);
    rows->AddNode(row, f, foot.node,
                  w * (near.value * slope * Vec3::Unit(k) + near.slope * pull * Vec3::UnitY()));
    rows->AddTurn(row, f, 0, -w * near.value * slope * way_by_angle[k] * heading.gradient);
    rows->AddAnchor(row, anchor, k / 2, -w * near.value * slope);
  }
  const double share = kHeightShare * w * Fade(d.y(), kLow, kHigh);
  const int row = rows->Add(share * r.y());
  rows->AddNode(row, f, foot.node, share * Vec3::UnitY());
}

}  // namespace retarget::solver
