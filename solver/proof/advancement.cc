#include "solver/proof/advancement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/proof/advancement_geometry.h"
#include "solver/proof/velocity_playback.h"

namespace retarget::solver {
namespace {

using Kind = RequirementKind;

constexpr double kSpare = 1e-9;      // m and turns: floating point certifies nothing
constexpr double kLeastStep = 1e-6;  // of an interval: nothing moves on
constexpr double kEnd = 1 + 1e-12;   // due after the end

// One thing that must stay so, and until when it is known to.
struct Item {
  Kind kind = Kind::kTangle;
  int item = -1, figure = -1;
  int n1 = 0, n2 = 0;
  double due = 0;
  int statement = -1;
};

class Advancer {
 public:
  Advancer(const ProofTask& task, const std::vector<Statement>& statements, int most)
      : task_(task), statements_(statements), most_(most), play_(task) {
    for (const TangleTarget& held : task.subject.tangles) {
      paths_.push_back({PathNodes(task.subject.body[0], held.tag.tangle.a),
                        PathNodes(task.subject.body[1], held.tag.tangle.b)});
    }
    for (int f = 0; f < 2; ++f) {
      const Body& body = task.subject.body[f];
      radius_[f].assign(body.nodes.size(), 0);
      for (int n = 1; n < body.num_nodes(); ++n) {
        for (const int end : {n, body.nodes[n].parent}) {
          radius_[f][end] = std::max(radius_[f][end], body.nodes[n].radius);
        }
      }
      start_[f].resize(task.subject.contacts[f].size());
    }
  }

  Advancement Run() {
    const int keys = task_.motion.num_keys();
    for (int key = 0; key < std::max(1, keys - 1); ++key) RunInterval(key);
    return std::move(out_);
  }

 private:
  std::vector<Item> ItemsOf(int key) const {
    std::vector<Item> items;
    const std::array<Body, 2>& body = task_.subject.body;
    for (int i = 1; i < body[0].num_nodes(); ++i) {
      for (int j = 1; j < body[1].num_nodes(); ++j) {
        items.push_back({Kind::kPassThroughs, -1, -1, i, j});
        items.push_back({Kind::kPenetration, -1, -1, i, j});
      }
    }
    for (int k = 0; k < static_cast<int>(paths_.size()); ++k) items.push_back({Kind::kTangle, k});
    for (int k = 0; k < static_cast<int>(task_.subject.holds.size()); ++k) {
      items.push_back({Kind::kHold, k});
    }
    for (int f = 0; f < 2; ++f) {
      const std::vector<Contact>& contacts = task_.subject.contacts[f];
      for (int c = 0; c < static_cast<int>(contacts.size()); ++c) {
        if (contacts[c].first <= key && key < contacts[c].last) {
          items.push_back({Kind::kFootDrift, -1, f, contacts[c].node, c});
        }
      }
      for (int n = 0; n < body[f].num_nodes(); ++n) {
        items.push_back({Kind::kFloor, -1, f, n});
        if (n == 0 || body[f].nodes[n].name.find("shoulder") != std::string::npos) continue;
        if (task_.subject.length[f][n] > 0) items.push_back({Kind::kSegmentLength, -1, f, n});
      }
    }
    return items;
  }

  // Finds each item's statement, and begins the interval's worst values.
  void Label(std::vector<Item>* items) {
    for (Item& i : *items) {
      for (size_t s = 0; s < statements_.size() && i.statement < 0; ++s) {
        const Statement& of = statements_[s];
        if (of.kind == i.kind && of.item == i.item && of.figure == i.figure) {
          i.statement = static_cast<int>(s);
        }
      }
    }
    out_.worst.emplace_back();
    for (const Statement& s : statements_) {
      out_.worst.back().push_back(s.kind == Kind::kTangle ? std::numeric_limits<double>::infinity()
                                                          : 0);
    }
  }

  void Meet(const Item& i, double value) {
    if (i.statement < 0 || i.kind == Kind::kPassThroughs) return;
    double& worst = out_.worst.back()[i.statement];
    worst = i.kind == Kind::kTangle ? std::min(worst, value) : std::max(worst, value);
  }

  void StartContacts(int key) {
    for (int f = 0; f < 2; ++f) {
      for (size_t c = 0; c < start_[f].size(); ++c) {
        const Contact& contact = task_.subject.contacts[f][c];
        if (contact.first == key) start_[f][c] = play_.Node(f, contact.node).p;
      }
    }
  }

  void RunInterval(int key) {
    play_.Enter(key);
    play_.At(0);
    StartContacts(key);
    std::vector<Item> items = ItemsOf(key);
    Label(&items);
    double u = 0;
    for (int looked = 0; u < 1 || looked == 0; ++looked) {
      ++out_.instants;
      double next = kEnd;
      for (Item& i : items) {
        if (i.due <= u) Advance(key, u, looked, &i);
        next = std::min(next, i.due);
      }
      u = next;
      if (u < 1) play_.At(u);
    }
  }

  void Advance(int key, double u, int looked, Item* i) {
    const auto [value, step] = ValueAndStep(*i);
    Meet(*i, value);
    if (step >= kLeastStep && looked < most_) {
      i->due = u + step;
      return;
    }
    const std::vector<double>& t = task_.motion.key_times;
    const int next = std::min(key + 1, task_.motion.num_keys() - 1);
    out_.failures.push_back(
        {i->kind, i->item, i->figure, t[key] + u * (t[next] - t[key]), value, LimbsOf(*i)});
    i->due = kEnd;
  }

  std::vector<LimbNode> LimbsOf(const Item& i) const {
    if (i.kind == Kind::kPassThroughs || i.kind == Kind::kPenetration) {
      return {{0, i.n1}, {1, i.n2}};
    }
    if (i.figure >= 0) return {{i.figure, i.n1}};
    return {};
  }

  MovingLine SegmentOf(int f, int n) const {
    return {play_.Node(f, task_.subject.body[f].nodes[n].parent), play_.Node(f, n)};
  }

  // The value now, and for how long the limit is kept for certain.
  std::pair<double, double> ValueAndStep(const Item& i) const {
    const Requirements& limits = task_.limits;
    switch (i.kind) {
      case Kind::kPassThroughs:
      case Kind::kPenetration: {
        const MovingLine x = SegmentOf(0, i.n1), y = SegmentOf(1, i.n2);
        const double d = SegmentDistance(x, y);
        const bool free = i.kind == Kind::kPassThroughs;
        const double depth =
            task_.subject.body[0].nodes[i.n1].radius + task_.subject.body[1].nodes[i.n2].radius - d;
        const double slack = (free ? d : limits.penetration_m - depth) - kSpare;
        return {free ? d : depth, StepFor(slack, RelativeOf(x, y))};
      }
      case Kind::kTangle:
        return Tag(i.item);
      case Kind::kHold: {
        const Hold& hold = task_.subject.holds[i.item];
        const PointState p = play_.Held(hold.from), q = play_.Held(hold.to);
        const double apart = (p.p - q.p).norm();
        return {apart, StepFor(limits.hold_m - apart - kSpare, RelativeOf(p, q))};
      }
      case Kind::kFootDrift: {
        const PointState& foot = play_.Node(i.figure, i.n1);
        const Vec3 from = foot.p - start_[i.figure][i.n2];
        const double drift = std::hypot(from.x(), from.z());
        const Relative r{std::hypot(foot.v.x(), foot.v.z()), foot.a};
        return {drift, StepFor(limits.foot_drift_m - drift - kSpare, r)};
      }
      case Kind::kFloor: {
        const PointState& node = play_.Node(i.figure, i.n1);
        const double depth = radius_[i.figure][i.n1] - node.p.y();
        return {depth, StepFor(limits.floor_m - depth - kSpare,
                               {std::abs(std::min(0.0, node.v.y())), node.a})};
      }
      case Kind::kSegmentLength:
        return Length(i);
      case Kind::kPenetrationOver1cm:
      case Kind::kFootTravel:
      case Kind::kFootAcceleration:
      case Kind::kPoseError:
      case Kind::kTrunkTilt:
      case Kind::kFloating:
      case Kind::kJointLimit:
      case Kind::kJerk:
      case Kind::kWriteBack:
        break;
    }
    return {0, 2};
  }

  std::pair<double, double> Length(const Item& i) const {
    const MovingLine s = SegmentOf(i.figure, i.n1);
    const double should = task_.subject.length[i.figure][i.n1];
    const Vec3 along = s.to.p - s.from.p;
    const double is = along.norm(), error = std::abs(is / should - 1);
    const double slack = should * (task_.limits.segment_length_percent / 100 - error) - kSpare;
    // A segment that its own joint turns keeps its length: both ends move, neither towards the
    // other, now or later. Its relative acceleration says nothing then, so the file's own bones do.
    if (KeepsLength(i)) return {100 * error, slack > 0 ? 2 : 0};
    return {100 * error, StepFor(slack, RelativeOf(s.from, s.to))};
  }

  // One bone of the file, from the joint that turns it to a node fixed in that joint.
  bool KeepsLength(const Item& i) const {
    const std::vector<KeyedNode>& nodes = task_.motion.nodes;
    const int p = task_.node[i.figure][i.n1];
    const int q = task_.node[i.figure][task_.subject.body[i.figure].nodes[i.n1].parent];
    if (nodes[p].translation_track >= 0) return false;
    const int joint = nodes[p].parent;
    for (int up = joint; up >= 0; up = nodes[up].parent) {
      if (nodes[up].stretch != Mat3::Identity()) return false;
    }
    // Where the joint stands, as q: by walking down from both to the first frame they share.
    if (joint == q || joint < 0) return joint == q;
    if (nodes[q].parent == joint && nodes[q].translation_track < 0) return true;
    if (nodes[joint].translation_track >= 0) return false;
    if (nodes[joint].parent == q) return nodes[joint].translation == Vec3::Zero();
    return nodes[joint].parent == nodes[q].parent && nodes[joint].parent >= 0 &&
           nodes[q].translation_track < 0 && nodes[joint].translation == nodes[q].translation;
  }

  std::pair<double, double> Tag(int k) const {
    const TangleTarget& held = task_.subject.tangles[k];
    const std::vector<int>&a = paths_[k][0], &b = paths_[k][1];
    double gli = 0;
    for (size_t i = 0; i + 1 < a.size(); ++i) {
      for (size_t j = 0; j + 1 < b.size(); ++j) {
        gli += PairGli(play_.Node(0, a[i]).p, play_.Node(0, a[i + 1]).p, play_.Node(1, b[j]).p,
                       play_.Node(1, b[j + 1]).p);
      }
    }
    gli *= held.sign < 0 ? -1 : 1;
    const double slack = gli - task_.limits.gli - kSpare;
    if (slack <= 0) return {gli, 0};
    // The longest of 1, 1/2, 1/4, ... in which the path ends cannot sweep that much.
    for (double h = 1; h >= kLeastStep; h /= 2) {
      const double swept = Swept(0, a.front(), 1, b, h) + Swept(0, a.back(), 1, b, h) +
                           Swept(1, b.front(), 0, a, h) + Swept(1, b.back(), 0, a, h);
      if (swept < slack) return {gli, h};
    }
    return {gli, 0};
  }

  // Share of the sphere that the directions from an end to a path sweep within h: per segment, the
  // way of the one relative to the other times the angle that the segment fills, over the nearest
  // that both can come to each other.
  double Swept(int f, int end, int g, const std::vector<int>& line, double h) const {
    const PointState& e = play_.Node(f, end);
    double sum = 0;
    for (size_t i = 0; i + 1 < line.size(); ++i) {
      const PointState &p = play_.Node(g, line[i]), &q = play_.Node(g, line[i + 1]);
      const Relative rp = RelativeOf(e, p), rq = RelativeOf(e, q);
      const double way = h * std::max(rp.v, rq.v) + h * h / 2 * std::max(rp.a, rq.a);
      const double near = EndDistance(e.p, p.p, q.p) - way;
      if (near <= 0) return std::numeric_limits<double>::infinity();
      const Relative stretch = RelativeOf(p, q);
      const double length =
          (p.p - q.p).norm() + std::min(h * stretch.v + h * h / 2 * stretch.a, 2 * way);
      // h / r^3 along a line at distance `near` or more: at most 2 / near, or length / near^2.
      sum += way * std::min(2 / near, length / (near * near));
    }
    return sum / (4 * kPi);
  }

  const ProofTask& task_;
  const std::vector<Statement>& statements_;
  const int most_;
  VelocityPlayback play_;
  std::vector<std::array<std::vector<int>, 2>> paths_;
  std::array<std::vector<double>, 2> radius_;
  std::array<std::vector<Vec3>, 2> start_;
  Advancement out_;
};

}  // namespace

Advancement CheckByAdvancement(const ProofTask& task, const std::vector<Statement>& statements,
                               int most_instants) {
  return Advancer(task, statements, most_instants).Run();
}

}  // namespace retarget::solver
