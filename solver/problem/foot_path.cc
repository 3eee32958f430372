#include "solver/problem/foot_path.h"

#include <algorithm>
#include <cmath>

namespace retarget::solver {
namespace {

// How high a foot is lifted that goes to another place than it did (m).
constexpr double kStepLift = 0.12;
// The same while no other foot of the figure stands: who lifts both feet at once hangs in the air.
constexpr double kHopLift = 0.04;
constexpr double kSettle = 0.3;  // s, in which the captured speed at a footprint's edge fades

// From rest to rest with least jerk; tau in [0, 1].
double LeastJerk(double tau) { return tau * tau * tau * (10 + tau * (-15 + 6 * tau)); }

Vec3 OverFloor(const Vec3& v) { return {v.x(), 0, v.z()}; }

// Of each node the foot that it belongs to, by its ankle; other nodes stand for themselves.
std::vector<int> FootOfNodes(const Body& body) {
  const std::vector<int> feet = FootNodes(body);
  const auto is_foot = [&](int n) { return std::find(feet.begin(), feet.end(), n) != feet.end(); };
  std::vector<int> foot;
  for (int n = 0; n < body.num_nodes(); ++n) {
    const int parent = body.nodes[n].parent;
    foot.push_back(is_foot(n) && parent >= 0 && is_foot(parent) ? parent : n);
  }
  return foot;
}

// A contact's first or last frame, as the way beside it sees it.
struct Edge {
  int frame = 0;
  Vec3 place = Vec3::Zero();  // of the contact's node in the source
  Vec3 speed = Vec3::Zero();  // m per frame
  double drop = 0;            // of the footprint's height under the captured one (m)

  // What is added to the captured way at frame t, so that it is at rest at the edge and at the
  // footprint's height; nothing from `settle` frames on.
  Vec3 Off(int t, double settle) const {
    const double k = t - frame, u = std::min(1.0, std::abs(k) / settle);
    const Vec3 off = -k * (1 - u) * (1 - u) * (1 - u) * speed;
    return {off.x(), -(1 - LeastJerk(u)) * drop, off.z()};
  }
};

// The ways of one figure's nodes.
class Planner {
 public:
  Planner(const Scene& scene, int figure, int first_anchor,
          std::vector<std::vector<FootPathPoint>>* paths)
      : scene_(scene),
        body_(scene.body[figure]),
        contacts_(scene.contacts[figure]),
        first_anchor_(first_anchor),
        node_(SourceNodes(scene, figure)),
        foot_of_(FootOfNodes(body_)),
        paths_(*paths) {
    for (const Contact& contact : contacts_) {
      nodes_.push_back(contact.node);
      height_.push_back(HeightOf(node_, contact));
    }
    const std::vector<int>& supports = scene.posture.supports[figure];
    nodes_.insert(nodes_.end(), supports.begin(), supports.end());
    std::sort(nodes_.begin(), nodes_.end());
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  }

  void Run() {
    for (const int n : nodes_) PlanNode(n);
    const size_t end = static_cast<size_t>(first_anchor_) + contacts_.size();
    for (size_t k = static_cast<size_t>(first_anchor_); k < end; ++k) {
      std::stable_sort(paths_[k].begin(), paths_[k].end(),
                       [](const FootPathPoint& p, const FootPathPoint& q) { return p.t < q.t; });
    }
  }

 private:
  const Contact& At(int k) const { return contacts_[static_cast<size_t>(k)]; }
  const Vec3& Place(int t, int n) const {
    return node_[static_cast<size_t>(t)][static_cast<size_t>(n)];
  }

  Edge EdgeOf(int k, int frame) const {
    const int n = At(k).node;
    const int before = std::max(frame - 1, 0), after = std::min(frame + 1, scene_.num_frames() - 1);
    Edge edge;
    edge.frame = frame;
    edge.place = Place(frame, n);
    if (after > before) edge.speed = (Place(after, n) - Place(before, n)) / (after - before);
    edge.drop = edge.place.y() - height_[static_cast<size_t>(k)];
    return edge;
  }

  // Where a foot stands with any of its nodes, without a break.
  struct Stance {
    int first = 0, last = 0;
    std::vector<int> contacts;
  };
  std::vector<Stance> StancesOf(int foot) const {
    std::vector<int> own;
    for (int k = 0; k < static_cast<int>(contacts_.size()); ++k) {
      if (foot_of_[static_cast<size_t>(At(k).node)] == foot) own.push_back(k);
    }
    std::sort(own.begin(), own.end(), [&](int k, int l) { return At(k).first < At(l).first; });
    std::vector<Stance> stances;
    for (const int k : own) {
      if (stances.empty() || At(k).first > stances.back().last + 1) {
        stances.push_back({At(k).first, At(k).last, {}});
      }
      stances.back().last = std::max(stances.back().last, At(k).last);
      stances.back().contacts.push_back(k);
    }
    return stances;
  }

  // Contacts of a stance: the last to end before t, and the first to begin after it; the node's own
  // where there is one. -1: none.
  int LastBefore(const Stance& stance, int n, int t, bool own) const {
    int last = -1;
    for (const int k : stance.contacts) {
      if (At(k).last >= t || (own && At(k).node != n)) continue;
      if (last < 0 || At(k).last > At(last).last) last = k;
    }
    return last;
  }
  int FirstAfter(const Stance& stance, int n, int t, bool own) const {
    int first = -1;
    for (const int k : stance.contacts) {
      if (At(k).first <= t || (own && At(k).node != n)) continue;
      if (first < 0 || At(k).first < At(first).first) first = k;
    }
    return first;
  }

  void PlanNode(int n) {
    const std::vector<Stance> stances = StancesOf(foot_of_[static_cast<size_t>(n)]);
    size_t next = 0;  // the first stance that has not ended before t
    for (int t = 0; t < scene_.num_frames(); ++t) {
      while (next < stances.size() && stances[next].last < t) ++next;
      if (next < stances.size() && stances[next].first <= t) {
        PlanStanding(t, n, stances[next]);
      } else if (next > 0 && next < stances.size()) {
        const Stance &left = stances[next - 1], &reached = stances[next];
        int from = LastBefore(left, n, t, true), to = FirstAfter(reached, n, t, true);
        if (from < 0) from = LastBefore(left, n, t, false);
        if (to < 0) to = FirstAfter(reached, n, t, false);
        PlanStep(t, n, from, to, left.last, reached.first);
      }
    }
  }

  // The foot stands, this node or another.
  void PlanStanding(int t, int n, const Stance& stance) {
    int standing = -1;
    for (const int k : stance.contacts) {
      if (At(k).first > t || At(k).last < t) continue;
      if (At(k).node == n) return;
      standing = k;
    }
    const int from = LastBefore(stance, n, t, true), to = FirstAfter(stance, n, t, true);
    if (from >= 0 && to >= 0) return PlanStep(t, n, from, to, At(from).last, At(to).first);
    const Vec3& s = Place(t, n);
    FootPathPoint point;
    point.t = t;
    point.node = n;
    if (from < 0 && to < 0) {
      if (standing < 0) return;
      const Vec3& other = Place(t, At(standing).node);
      point.way = OverFloor(s - other);
      point.height = s.y() - other.y() + height_[static_cast<size_t>(standing)];
      return Keep(standing, point);
    }
    const Edge edge = from >= 0 ? EdgeOf(from, At(from).last) : EdgeOf(to, At(to).first);
    if (std::abs(t - edge.frame) > Longest()) return;
    const Vec3 off = edge.Off(t, kSettle * scene_.fps());
    point.way = OverFloor(s - edge.place + off);
    point.height = s.y() + off.y();
    Keep(from >= 0 ? from : to, point);
  }

  // From one contact to another; the foot is carried over between frames `lifted` and `landed`.
  void PlanStep(int t, int n, int from, int to, int lifted, int landed) {
    const Edge left = EdgeOf(from, At(from).last), reached = EdgeOf(to, At(to).first);
    const double frames = reached.frame - left.frame;
    if (frames > Longest()) return;
    const double tau = std::clamp((t - lifted) / std::max(1.0, 1.0 * landed - lifted), 0.0, 1.0);
    const double settle = std::min(kSettle * scene_.fps(), 0.5 * frames);
    const Vec3 off = left.Off(t, settle) + reached.Off(t, settle);
    const Vec3& s = Place(t, n);
    FootPathPoint point;
    point.t = t;
    point.node = n;
    point.to = first_anchor_ + to;
    point.u = LeastJerk(tau);
    point.way = OverFloor(s - left.place + off);
    point.way_to_next = OverFloor(s - reached.place + off);
    point.height = s.y() + off.y();
    point.stride = OverFloor(reached.place - left.place);
    point.lift = std::pow(4 * tau * (1 - tau), 3) * MostLift(n, left, reached, lifted, landed);
    Keep(from, point);
  }

  double Longest() const { return kLongestStep * scene_.fps(); }

  // Whether another foot than node n's stands all the while between two frames.
  bool AnotherStands(int n, int first, int last) const {
    for (int t = first + 1; t < last; ++t) {
      const bool stands = std::any_of(contacts_.begin(), contacts_.end(), [&](const Contact& c) {
        return c.first <= t && t <= c.last &&
               foot_of_[static_cast<size_t>(c.node)] != foot_of_[static_cast<size_t>(n)];
      });
      if (!stands) return false;
    }
    return true;
  }

  // Less for a foot that went high anyway.
  double MostLift(int n, const Edge& left, const Edge& reached, int lifted, int landed) const {
    const double floor = std::min(Place(left.frame, n).y(), Place(reached.frame, n).y());
    double highest = 0;
    for (int t = left.frame; t <= reached.frame; ++t) {
      highest = std::max(highest, Place(t, n).y() - floor);
    }
    const double most = AnotherStands(n, lifted, landed) ? kStepLift : kHopLift;
    return std::max(0.0, most - highest);
  }

  void Keep(int k, const FootPathPoint& point) {
    paths_[static_cast<size_t>(first_anchor_ + k)].push_back(point);
  }

  const Scene& scene_;
  const Body& body_;
  const std::vector<Contact>& contacts_;
  const int first_anchor_;
  const std::vector<std::vector<Vec3>> node_;  // of the source, per frame
  const std::vector<int> foot_of_;             // per node
  std::vector<double> height_;                 // per contact
  std::vector<int> nodes_;                     // that may stand
  std::vector<std::vector<FootPathPoint>>& paths_;
};

}  // namespace

std::vector<std::vector<FootPathPoint>> FootPaths(const Scene& scene) {
  std::vector<std::vector<FootPathPoint>> paths(scene.contacts[0].size() +
                                                scene.contacts[1].size());
  for (int f = 0; f < 2; ++f) {
    if (scene.contacts[f].empty()) continue;
    Planner(scene, f, f == 0 ? 0 : static_cast<int>(scene.contacts[0].size()), &paths).Run();
  }
  return paths;
}

double HeightOf(const std::vector<std::vector<Vec3>>& node, const Contact& contact) {
  double sum = 0;
  for (int t = contact.first; t <= contact.last; ++t) {
    sum += node[static_cast<size_t>(t)][static_cast<size_t>(contact.node)].y();
  }
  return sum / (contact.last - contact.first + 1);
}

std::vector<std::vector<Vec3>> SourceNodes(const Scene& scene, int figure) {
  std::vector<std::vector<Vec3>> nodes;
  for (const Pose& pose : scene.source[figure].frames) {
    nodes.push_back(PoseBody(scene.body[figure], pose).node);
  }
  return nodes;
}

}  // namespace retarget::solver
