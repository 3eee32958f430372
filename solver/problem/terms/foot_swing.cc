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
// A foot that is further off its path (m) is pulled no more: it is led away, and held back it would
// be flung after its body once it is let go.
constexpr double kMostPull = 0.1;
constexpr double kLeastWeight = 1e-3;  // less guides nothing
// Over its captured height a foot is pulled so much less: it may always step higher.
constexpr double kHigherShare = 0.2,
                 kRound = 0.002;  // within kRound (m) the one goes into the other
// Distance by which a step is another than the captured one (m), for which a foot is lifted half
// as high as it is at most.
constexpr double kStepHalf = 0.1;
constexpr double kMidStep = 0.4;  // weight half way of a step, where it may go round what is there
// A foot that is never planted is low under the one, and high over the other (m over its lowest).
constexpr double kFreeLow = 0.05, kFreeHigh = 0.1;

// Half way of a step.
double LeastJerkBell(double u) { return std::pow(4 * u * (1 - u), 2); }

// A height over the wanted one (m) and its derivative, flatter where it is positive.
struct Above {
  double value, slope;
  explicit Above(double x) {
    const double mean = 0.5 * (1 + kHigherShare), half = 0.5 * (1 - kHigherShare);
    const double root = std::hypot(x, kRound);
    value = mean * x - half * (root - kRound);
    slope = mean - half * x / root;
  }
};

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

}  // namespace

Contact FootSwing::Reach(const Scene& scene, int figure, const Contact& contact) {
  const int most = static_cast<int>(std::ceil(kLongestStep * scene.fps()));
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
  std::vector<std::vector<FootPathPoint>> paths = FootPaths(scene);
  const size_t frames = static_cast<size_t>(scene.num_frames());
  for (int f = 0; f < 2; ++f) {
    const std::vector<Contact>& contacts = scene.contacts[f];
    if (contacts.empty()) continue;
    const std::vector<std::vector<Vec3>> node = SourceNodes(scene, f);
    FindFree(scene, f, node);
    const size_t first = feet_.size();
    std::vector<std::vector<char>> covered(scene.body[f].nodes.size(),
                                           std::vector<char>(frames, 0));
    for (size_t k = 0; k < contacts.size(); ++k) {
      for (const FootPathPoint& point : paths[first + k]) covered[point.node][point.t] = 1;
    }
    for (size_t k = 0; k < contacts.size(); ++k) {
      Foot foot;
      foot.figure = f;
      foot.node = contacts[k].node;
      foot.height = HeightOf(node, contacts[k]);
      Guide(scene, node, contacts[k], covered[contacts[k].node], &foot);
      foot.path = std::move(paths[first + k]);
      feet_.push_back(std::move(foot));
    }
  }
}

void FootSwing::FindFree(const Scene& scene, int figure,
                         const std::vector<std::vector<Vec3>>& node) {
  const std::vector<Contact>& contacts = scene.contacts[figure];
  const Body& body = scene.body[figure];
  for (const int n : scene.posture.supports[figure]) {
    const bool planted = std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
      return c.node == n || body.nodes[c.node].parent == n || body.nodes[n].parent == c.node;
    });
    if (planted) continue;
    Free free;
    free.node = n;
    for (const std::vector<Vec3>& posed : node) free.height.push_back(posed[n].y());
    const double lowest = *std::min_element(free.height.begin(), free.height.end());
    for (const double h : free.height) {
      free.weight.push_back(Fade(h - lowest, kFreeLow, kFreeHigh));
    }
    free_[figure].push_back(std::move(free));
  }
}

void FootSwing::Guide(const Scene& scene, const std::vector<std::vector<Vec3>>& node,
                      const Contact& contact, const std::vector<char>& covered, Foot* foot) const {
  const int n = contact.node;
  const Contact reach = Reach(scene, foot->figure, contact);
  double highest = 0;  // since the contact's end (m over its height)
  const auto guide = [&](int t, int edge) {
    const double time = std::abs(t - edge) / scene.fps();
    highest = std::max(highest, node[t][n].y() - foot->height);
    const double weight = std::max(Fade(time, kSoon, kLate), Fade(highest, kLow, kHigh));
    if (weight < kLeastWeight || covered[t]) return false;
    foot->guided.push_back({t, weight, node[t][n] - node[edge][n]});
    return true;
  };
  for (int t = contact.first - 1; t >= reach.first && guide(t, contact.first);) --t;
  std::reverse(foot->guided.begin(), foot->guided.end());
  highest = 0;
  for (int t = contact.last + 1; t <= reach.last && guide(t, contact.last);) ++t;
}

int FootSwing::row_slots(const Frame& frame) const {
  const auto here = [&](const auto& part) { return part.t == frame.t; };
  long rows = 0;
  for (const Foot& foot : feet_) {
    rows += std::count_if(foot.guided.begin(), foot.guided.end(), here);
    rows += std::count_if(foot.path.begin(), foot.path.end(), here);
  }
  rows *= 3;
  for (const std::vector<Free>& free : free_) rows += static_cast<long>(free.size());
  return static_cast<int>(rows);
}

void FootSwing::EvaluatePart(const Frame& frame, int anchor, Rows* rows) const {
  const size_t k = static_cast<size_t>(anchor);
  const Foot& foot = feet_[k];
  const auto earlier = [](const auto& part, int t) { return part.t < t; };
  const auto guided = std::lower_bound(foot.guided.begin(), foot.guided.end(), frame.t, earlier);
  if (guided != foot.guided.end() && guided->t == frame.t) {
    EvaluateGuided(frame, anchor, *guided, rows);
  }
  auto point = std::lower_bound(foot.path.begin(), foot.path.end(), frame.t, earlier);
  for (; point != foot.path.end() && point->t == frame.t; ++point) {
    EvaluatePath(frame, anchor, *point, rows);
  }
  if (k == 0 || feet_[k - 1].figure != foot.figure) EvaluateFree(frame, foot.figure, rows);
}

void FootSwing::EvaluateFree(const Frame& frame, int figure, Rows* rows) const {
  for (const Free& free : free_[static_cast<size_t>(figure)]) {
    const size_t t = static_cast<size_t>(frame.t);
    const Above above(frame.posed[figure].node[free.node].y() - free.height[t]);
    const int row = rows->Add(free.weight[t] * above.value);
    rows->AddNode(row, figure, free.node, free.weight[t] * above.slope * Vec3::UnitY());
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
  const double share = w * Fade(way.y(), kLow, kHigh);
  const Above above(r.y());
  const int row = rows->Add(share * above.value);
  rows->AddNode(row, f, foot.node, share * above.slope * Vec3::UnitY());
}

void FootSwing::EvaluatePath(const Frame& frame, int anchor, const FootPathPoint& point,
                             Rows* rows) const {
  const int f = feet_[static_cast<size_t>(anchor)].figure;
  const Turned turned(frame, f);
  const int next = point.to >= 0 ? point.to : anchor;
  const double u = point.u, v = 1 - u;
  const auto from = frame.anchor->col(anchor), to = frame.anchor->col(next);
  const Vec3 way = v * point.way + u * point.way_to_next;
  const Vec3 place =
      turned.Way(way) + Vec3(v * from[0] + u * to[0], point.height, v * from[1] + u * to[1]);
  const Vec3 place_by_angle = turned.ByAngle(way);
  const Vec3 r = frame.posed[f].node[point.node] - place;
  const double w = 1 - (1 - kMidStep) * LeastJerkBell(u);
  for (const int k : {0, 2}) {
    const int row = rows->Add(w * r[k]);
    rows->AddNode(row, f, point.node, w * Vec3::Unit(k));
    rows->AddTurn(row, f, 0, -w * place_by_angle[k] * turned.gradient());
    rows->AddAnchor(row, anchor, k / 2, -w * v);
    if (point.to >= 0) rows->AddAnchor(row, next, k / 2, -w * u);
  }
  // D, the captured step turned: a' - a - R (s(e') - s(e)).
  const Vec3 stride = Vec3(to[0] - from[0], 0, to[1] - from[1]) - turned.Way(point.stride);
  const double square = stride.x() * stride.x() + stride.z() * stride.z();
  const double half = kStepHalf * kStepHalf;
  const double lift = point.lift * square / (square + half);
  const double by_square = point.lift * half / ((square + half) * (square + half));
  const Vec3 stride_by_angle = -turned.ByAngle(point.stride);
  const double square_by_angle =
      2 * (stride.x() * stride_by_angle.x() + stride.z() * stride_by_angle.z());
  const Above above(r.y() - lift);
  const double height = w * above.slope;
  const int row = rows->Add(w * above.value);
  rows->AddNode(row, f, point.node, height * Vec3::UnitY());
  if (point.to < 0) return;
  rows->AddTurn(row, f, 0, -height * by_square * square_by_angle * turned.gradient());
  for (const int k : {0, 2}) {
    const double by_anchor = height * 2 * by_square * stride[k];
    rows->AddAnchor(row, anchor, k / 2, by_anchor);
    rows->AddAnchor(row, next, k / 2, -by_anchor);
  }
}

}  // namespace retarget::solver
