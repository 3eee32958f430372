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
// In a step: how high a foot is lifted that goes to another place than it did (m), and the
// distance for which it is lifted half as high.
constexpr double kStepLift = 0.12, kStepHalf = 0.1;
constexpr double kStepHeightShare = 1;  // of the height, beside the place over the floor
constexpr double kSettle = 0.3;  // s, in which the captured speed at a footprint's edge fades
// Share of a node's step in which the whole foot must be free.
constexpr double kLeastFree = 0.5;

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

// From rest to rest with least jerk; tau in [0, 1].
double LeastJerk(double tau) { return tau * tau * tau * (10 + tau * (-15 + 6 * tau)); }

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

// How the edit has turned a figure's root about the vertical, and ways of the source turned so.
class Turned {
 public:
  Turned(const Frame& frame, int figure)
      : heading_(HeadingOf(frame.pose[figure].rotation[0] *
                           frame.scene->source[figure].frames[frame.t].rotation[0].conjugate())) {}

  Vec3 Way(const Vec3& d) const {
    const double c = heading_.cosine, s = heading_.sine;
    return {c * d.x() + s * d.z(), d.y(), -s * d.x() + c * d.z()};
  }
  Vec3 ByAngle(const Vec3& d) const {
    const double c = heading_.cosine, s = heading_.sine;
    return {-s * d.x() + c * d.z(), 0, -c * d.x() - s * d.z()};
  }
  // Of the angle by a turn of the root.
  const Vec3& gradient() const { return heading_.gradient; }

 private:
  Heading heading_;
};

Vec3 OverFloor(const Vec3& v) { return {v.x(), 0, v.z()}; }

// Where a captured foot leaves its footprint or comes to it.
struct Edge {
  Vec3 place;     // in the source
  Vec3 speed;     // m per frame
  double height;  // of the footprint (m)

  // What is added to the captured way `k` frames after the edge (before it: negative), so that it
  // is at rest there and at the footprint's height; nothing from `settle` frames on.
  Vec3 Off(double k, double settle) const {
    const double u = std::min(1.0, std::abs(k) / settle);
    const Vec3 off = -k * (1 - u) * (1 - u) * (1 - u) * speed;
    return {off.x(), (1 - LeastJerk(u)) * (height - place.y()), off.z()};
  }
};

// Times (frames) between which a whole foot is free in a step of one of its nodes: the other node
// of the foot lands and lifts off, too. Where that node does not step once in the meantime, the
// step's own.
struct Span {
  double from, to;
};
Span FreeSpan(const Body& body, const std::vector<Contact>& contacts, const Contact& from,
              const Contact& to) {
  Span span{static_cast<double>(from.last), static_cast<double>(to.first)};
  const Span own = span;
  int steps = 0;
  for (size_t k = 0; k + 1 < contacts.size(); ++k) {
    const Contact &c = contacts[k], &next = contacts[k + 1];
    const bool same_foot =
        body.nodes[c.node].parent == from.node || body.nodes[from.node].parent == c.node;
    if (!same_foot || next.node != c.node || next.first <= own.from || c.last >= own.to) continue;
    ++steps;
    span.from = std::max<double>(span.from, c.last);
    span.to = std::min<double>(span.to, next.first);
  }
  return steps == 1 && span.to - span.from >= kLeastFree * (own.to - own.from) ? span : own;
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
  const int most = static_cast<int>(std::ceil(kLongest * scene.fps()));
  for (int f = 0; f < 2; ++f) {
    const std::vector<Contact>& contacts = scene.contacts[f];
    if (contacts.empty()) continue;
    std::vector<std::vector<Vec3>> node;
    for (const Pose& pose : scene.source[f].frames) {
      node.push_back(PoseBody(scene.body[f], pose).node);
    }
    const size_t first = feet_.size();
    for (const Contact& contact : contacts) {
      Foot foot;
      foot.figure = f;
      foot.node = contact.node;
      for (int t = contact.first; t <= contact.last; ++t) foot.height += node[t][contact.node].y();
      foot.height /= contact.last - contact.first + 1;
      feet_.push_back(std::move(foot));
    }
    // A contact and the node's next one, where a step leads from one to the other.
    const auto next_of = [&](size_t k) {
      const bool has = k + 1 < contacts.size() && contacts[k + 1].node == contacts[k].node &&
                       contacts[k + 1].first - contacts[k].last <= most;
      return has ? static_cast<int>(k + 1) : -1;
    };
    for (size_t k = 0; k < contacts.size(); ++k) {
      const Contact& contact = contacts[k];
      Foot& foot = feet_[first + k];
      const int next = next_of(k);
      const bool led_to = k > 0 && next_of(k - 1) == static_cast<int>(k);
      Guide(scene, node, contact, !led_to, next < 0, &foot);
      if (next < 0) continue;
      const Contact& to = contacts[static_cast<size_t>(next)];
      foot.next = static_cast<int>(first) + next;
      foot.first = contact.last + 1;
      const Span free = FreeSpan(scene.body[f], contacts, contact, to);
      const auto place = [&](int t) { return node[t][contact.node]; };
      const auto speed = [&](int t) {
        const int before = std::max(t - 1, 0), after = std::min(t + 1, scene.num_frames() - 1);
        return Vec3((place(after) - place(before)) / (after - before));
      };
      const Edge left{place(contact.last), speed(contact.last), foot.height},
          reached{place(to.first), speed(to.first), feet_[static_cast<size_t>(foot.next)].height};
      const double settle =
          std::min(kSettle * scene.fps(), 0.5 * (to.first - contact.last));  // frames
      double highest = 0;
      for (int t = foot.first; t < to.first; ++t) {
        const double tau =
            std::clamp((t - free.from) / std::max(1.0, free.to - free.from), 0.0, 1.0);
        const Vec3 s = place(t);
        const Vec3 since = left.Off(t - contact.last, settle),
                   until = reached.Off(t - to.first, settle);
        Stepping step{LeastJerk(tau), std::pow(4 * tau * (1 - tau), 3),
                      s.y() + since.y() + until.y(), s - left.place + since,
                      s - reached.place + until};
        // Each footprint's own way knows of the speed at the other, too.
        step.way += OverFloor(until);
        step.before += OverFloor(since);
        step.way.y() = step.before.y() = 0;
        foot.stepping.push_back(step);
        highest = std::max(highest, s.y() - foot.height);
      }
      foot.stride = OverFloor(reached.place - left.place);
      foot.most_lift = std::max(0.0, kStepLift - highest);
    }
  }
}

void FootSwing::Guide(const Scene& scene, const std::vector<std::vector<Vec3>>& node,
                      const Contact& contact, bool before, bool after, Foot* foot) const {
  const int n = contact.node;
  const Contact reach = Reach(scene, foot->figure, contact);
  double highest = 0;  // since the contact's end (m over its height)
  const auto guide = [&](int t, int edge) {
    const double time = std::abs(t - edge) / scene.fps();
    highest = std::max(highest, node[t][n].y() - foot->height);
    const double weight = std::max(Fade(time, kSoon, kLate), Fade(highest, kLow, kHigh));
    if (weight < kLeastWeight) return false;
    foot->guided.push_back({t, weight, node[t][n] - node[edge][n]});
    return true;
  };
  for (int t = contact.first - 1; before && t >= reach.first && guide(t, contact.first);) --t;
  std::reverse(foot->guided.begin(), foot->guided.end());
  highest = 0;
  for (int t = contact.last + 1; after && t <= reach.last && guide(t, contact.last);) ++t;
}

int FootSwing::row_slots(const Frame& frame) const {
  int rows = 0;
  for (const Foot& foot : feet_) {
    for (const Guided& g : foot.guided) rows += g.t == frame.t ? 3 : 0;
    const int step = frame.t - foot.first;
    if (step >= 0 && step < static_cast<int>(foot.stepping.size())) rows += 3;
  }
  return rows;
}

void FootSwing::EvaluatePart(const Frame& frame, int anchor, Rows* rows) const {
  const Foot& foot = feet_[static_cast<size_t>(anchor)];
  const auto guided = std::lower_bound(foot.guided.begin(), foot.guided.end(), frame.t,
                                       [](const Guided& g, int t) { return g.t < t; });
  if (guided != foot.guided.end() && guided->t == frame.t) {
    EvaluateGuided(frame, anchor, *guided, rows);
  }
  const int step = frame.t - foot.first;
  if (step >= 0 && step < static_cast<int>(foot.stepping.size())) {
    EvaluateStep(frame, anchor, foot.stepping[static_cast<size_t>(step)], rows);
  }
}

void FootSwing::EvaluateGuided(const Frame& frame, int anchor, const Guided& guided,
                               Rows* rows) const {
  const Foot& foot = feet_[static_cast<size_t>(anchor)];
  const int f = foot.figure;
  const Turned turned(frame, f);
  const double w = guided.weight;
  const Vec3 way = turned.Way(guided.way), way_by_angle = turned.ByAngle(guided.way);
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
    rows->AddTurn(row, f, 0, -w * near.value * slope * way_by_angle[k] * turned.gradient());
    rows->AddAnchor(row, anchor, k / 2, -w * near.value * slope);
  }
  const double share = kHeightShare * w * Fade(way.y(), kLow, kHigh);
  const int row = rows->Add(share * r.y());
  rows->AddNode(row, f, foot.node, share * Vec3::UnitY());
}

void FootSwing::EvaluateStep(const Frame& frame, int anchor, const Stepping& step,
                             Rows* rows) const {
  const Foot& foot = feet_[static_cast<size_t>(anchor)];
  const int f = foot.figure;
  const Turned turned(frame, f);
  const double u = step.u, v = 1 - step.u;
  const auto from = frame.anchor->col(anchor), to = frame.anchor->col(foot.next);
  const Vec3 way = v * step.way + u * step.before;
  const Vec3 place =
      turned.Way(way) + Vec3(v * from[0] + u * to[0], step.height, v * from[1] + u * to[1]);
  const Vec3 place_by_angle = turned.ByAngle(way);
  const Vec3 r = frame.posed[f].node[foot.node] - place;
  for (const int k : {0, 2}) {
    const int row = rows->Add(r[k]);
    rows->AddNode(row, f, foot.node, Vec3::Unit(k));
    rows->AddTurn(row, f, 0, -place_by_angle[k] * turned.gradient());
    rows->AddAnchor(row, anchor, k / 2, -v);
    rows->AddAnchor(row, foot.next, k / 2, -u);
  }
  // D, the captured step turned: a' - a - R (s(e') - s(e)).
  const Vec3 stride = Vec3(to[0] - from[0], 0, to[1] - from[1]) - turned.Way(foot.stride);
  const double square = stride.x() * stride.x() + stride.z() * stride.z();
  const double half = kStepHalf * kStepHalf, scale = foot.most_lift * step.lift;
  const double lift = scale * square / (square + half);
  const double by_square = scale * half / ((square + half) * (square + half));
  const Vec3 stride_by_angle = -turned.ByAngle(foot.stride);
  const double square_by_angle =
      2 * (stride.x() * stride_by_angle.x() + stride.z() * stride_by_angle.z());
  const int row = rows->Add(kStepHeightShare * (r.y() - lift));
  rows->AddNode(row, f, foot.node, kStepHeightShare * Vec3::UnitY());
  rows->AddTurn(row, f, 0, -kStepHeightShare * by_square * square_by_angle * turned.gradient());
  for (const int k : {0, 2}) {
    const double by_anchor = kStepHeightShare * 2 * by_square * stride[k];
    rows->AddAnchor(row, anchor, k / 2, by_anchor);
    rows->AddAnchor(row, foot.next, k / 2, -by_anchor);
  }
}

}  // namespace retarget::solver
