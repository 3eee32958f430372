#include "solver/problem/terms/foot_swing.h"

#include <algorithm>
#include <cmath>

namespace retarget::solver {
namespace {

// The foot is guided in full under the first, not at all over the second: heights over its contact
// (m), as of a toe that clears the floor and of one that has left it; and times from the contact's
// end (s), as of a step's beginning and of half a slow step.
constexpr double kLow = 0.02, kHigh = 0.08;
constexpr double kSoon = 0.1, kLate = 0.4;
constexpr double kLeastWeight = 1e-3;  // less guides nothing

// 1 up to `full`, 0 from `none` on, smooth between.
double Fade(double x, double full, double none) {
  const double u = std::clamp((x - full) / (none - full), 0.0, 1.0);
  return 1 - u * u * (3 - 2 * u);
}

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
  const int most = static_cast<int>(std::ceil(kLate * scene.fps()));
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
      const auto guide = [&](int t, int edge) {
        const double weight = Fade(node[t][n].y() - foot.height, kLow, kHigh) *
                              Fade(std::abs(t - edge) / scene.fps(), kSoon, kLate);
        if (weight < kLeastWeight) return false;
        foot.guided.push_back({t, weight, node[t][n] - node[edge][n]});
        return true;
      };
      for (int t = contact.first - 1; t >= reach.first && guide(t, contact.first);) --t;
      std::reverse(foot.guided.begin(), foot.guided.end());
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
  const Vec3 r = frame.posed[f].node[foot.node] - Vec3(at[0], foot.height, at[1]) - way;
  for (int k = 0; k < 3; ++k) {
    const int row = rows->Add(w * r[k]);
    rows->AddNode(row, f, foot.node, w * Vec3::Unit(k));
    if (k == 1) continue;
    rows->AddTurn(row, f, 0, -w * way_by_angle[k] * heading.gradient);
    rows->AddAnchor(row, anchor, k / 2, -w);
  }
}

}  // namespace retarget::solver
