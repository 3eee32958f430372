// Two small figures with random keys, for tests of proofs: a root with two limbs of two segments
// each, and a playback of its own.
#pragma once

#include <random>

#include "model/geometry/capsule.h"
#include "model/geometry/polyline.h"
#include "model/geometry/so3.h"
#include "solver/proof/advancement.h"
#include "solver/proof/proof.h"

namespace retarget::solver {

struct RandomScene {
  KeyedMotion motion;
  std::array<std::vector<int>, 2> node;
  MetricsContext subject;
  Requirements limits;

  ProofTask task() const { return {motion, node, subject, limits}; }
};

class SceneMaker {
 public:
  explicit SceneMaker(unsigned seed) : random_(seed) {}

  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec3 Within(double size) {
    return Vec3(Uniform(-size, size), Uniform(-size, size), Uniform(-size, size));
  }
  Vec3 Direction() {
    std::normal_distribution<double> normal;
    return Vec3(normal(random_), normal(random_), normal(random_)).normalized();
  }

  // Figures whose roots are about `apart` (m) from each other. Between keys joints turn by up to
  // `turn` (rad) and roots move by up to `step` (m).
  RandomScene Make(int keys, double turn, double step, double apart) {
    RandomScene s;
    for (int k = 0; k < keys; ++k) s.motion.key_times.push_back(k / 30.0);
    for (int f = 0; f < 2; ++f) AddFigure(&s, f, keys, turn, step, f == 0 ? 0 : apart);
    AddTag(&s);
    return s;
  }

 private:
  void AddFigure(RandomScene* s, int f, int keys, double turn, double step, double away) {
    constexpr int kParent[] = {-1, 0, 1, 0, 3};
    Body& body = s->subject.body[f];
    Vec3 root = Vec3(away, 1, 0) + Within(0.1);
    for (int n = 0; n < 5; ++n) {
      Link link;
      link.parent = kParent[n];
      body.links.push_back(link);
      Node of_body;
      of_body.name = "n" + std::to_string(n);
      of_body.parent = kParent[n];
      of_body.link = n;
      of_body.radius = n == 0 ? 0 : Uniform(0.01, 0.04);
      body.nodes.push_back(of_body);

      KeyedNode node;
      const int first = f * 5;
      node.parent = kParent[n] < 0 ? -1 : first + kParent[n];
      if (n > 0) node.translation = Uniform(0.15, 0.35) * Direction();
      node.rotation_track = static_cast<int>(s->motion.rotation_tracks.size());
      s->motion.rotation_tracks.emplace_back();
      Quat q = ExpSo3(Uniform(0, 3) * Direction());
      for (int k = 0; k < keys; ++k) {
        s->motion.rotation_tracks.back().push_back(q);
        q = (q * ExpSo3(Uniform(0, turn) * Direction())).normalized();
      }
      if (n == 0) {
        node.translation_track = static_cast<int>(s->motion.translation_tracks.size());
        s->motion.translation_tracks.emplace_back();
        for (int k = 0; k < keys; ++k) {
          s->motion.translation_tracks.back().push_back(root);
          root += Within(step);
        }
      }
      s->node[f].push_back(static_cast<int>(s->motion.nodes.size()));
      s->motion.nodes.push_back(node);
      s->subject.length[f].push_back(node.translation.norm());
    }
  }

  // One limb's end to the other's, of both.
  static void AddTag(RandomScene* s) {
    TangleTarget held;
    held.tag.tangle.a = held.tag.tangle.b = Path{2, 4};
    s->subject.tangles.push_back(held);
  }

  std::mt19937 random_;
};

// Places of all nodes at `u` in [0, 1] between two keys, and the rotations of their parents'
// frames.
inline PostureSample PlacesAt(const RandomScene& s, int key, double u) {
  PostureSample out;
  std::vector<Quat> world(s.motion.nodes.size());
  std::vector<Vec3> at(s.motion.nodes.size());
  const size_t k = static_cast<size_t>(key);
  const size_t next = std::min(k + 1, s.motion.key_times.size() - 1);
  for (size_t n = 0; n < s.motion.nodes.size(); ++n) {
    const KeyedNode& node = s.motion.nodes[n];
    Quat q = node.rotation;
    if (node.rotation_track >= 0) {
      const std::vector<Quat>& track =
          s.motion.rotation_tracks[static_cast<size_t>(node.rotation_track)];
      q = track[k] * ExpSo3(u * LogSo3(track[k].conjugate() * track[next]));
    }
    Vec3 p = node.translation;
    if (node.translation_track >= 0) {
      const std::vector<Vec3>& track =
          s.motion.translation_tracks[static_cast<size_t>(node.translation_track)];
      p = (1 - u) * track[k] + u * track[next];
    }
    if (node.parent < 0) {
      at[n] = p;
      world[n] = q;
      continue;
    }
    const size_t up = static_cast<size_t>(node.parent);
    at[n] = at[up] + world[up] * p;
    world[n] = world[up] * q;
  }
  for (size_t f = 0; f < 2; ++f) {
    for (const int n : s.node[f]) {
      const int parent = s.motion.nodes[static_cast<size_t>(n)].parent;
      out.node[f].push_back(at[static_cast<size_t>(n)]);
      out.rotation[f].push_back(world[static_cast<size_t>(parent < 0 ? n : parent)]);
    }
  }
  return out;
}

inline MotionView ViewOf(const RandomScene& s) {
  MotionView view;
  view.num_frames = s.motion.num_keys();
  view.fps = 30;
  view.at = [&s](double frame, PostureSample* sample) {
    const int key = std::min(static_cast<int>(frame), s.motion.num_keys() - 1);
    *sample = PlacesAt(s, key, frame - key);
  };
  return view;
}

// What is measured at an instant, from points alone: the worst of each kind.
struct Worst {
  double gli = 1e9, depth = 0, hold = 0, floor = 0, drift = 0;
  void Take(const Worst& w) {
    gli = std::min(gli, w.gli);
    depth = std::max(depth, w.depth);
    hold = std::max(hold, w.hold);
    floor = std::max(floor, w.floor);
    drift = std::max(drift, w.drift);
  }
};

inline Vec3 HeldPlace(const PostureSample& now, const HoldPoint& p) {
  if (p.figure == kWorld) return p.offset;
  const size_t f = static_cast<size_t>(p.figure), n = static_cast<size_t>(p.node);
  return now.node[f][n] + now.rotation[f][n] * p.offset;
}

// `start`: the posture in which contacts begin.
inline Worst WorstBetween(const RandomScene& s, const PostureSample& now,
                          const PostureSample& start) {
  Worst w;
  const std::array<Body, 2>& body = s.subject.body;
  for (const TangleTarget& held : s.subject.tangles) {
    std::vector<Vec3> p, q;
    for (const int n : NodesOn(body[0], held.tag.tangle.a)) p.push_back(now.node[0][size_t(n)]);
    for (const int n : NodesOn(body[1], held.tag.tangle.b)) q.push_back(now.node[1][size_t(n)]);
    w.gli = std::min(w.gli, held.sign * PolylineGli(p, q));
  }
  for (size_t i = 1; i < 5; ++i) {
    for (size_t j = 1; j < 5; ++j) {
      const ClosestPoints c =
          ClosestPointsOfSegments(now.node[0][size_t(body[0].nodes[i].parent)], now.node[0][i],
                                  now.node[1][size_t(body[1].nodes[j].parent)], now.node[1][j]);
      w.depth =
          std::max(w.depth, CapsuleDepth(c, body[0].nodes[i].radius, body[1].nodes[j].radius));
    }
  }
  for (const Hold& hold : s.subject.holds) {
    w.hold = std::max(w.hold, (HeldPlace(now, hold.from) - HeldPlace(now, hold.to)).norm());
  }
  for (size_t f = 0; f < 2; ++f) {
    for (size_t n = 0; n < 5; ++n) {
      double radius = body[f].nodes[n].radius;
      for (const Node& child : body[f].nodes) {
        if (child.parent == static_cast<int>(n)) radius = std::max(radius, child.radius);
      }
      w.floor = std::max(w.floor, radius - now.node[f][n].y());
    }
    for (const Contact& c : s.subject.contacts[f]) {
      Vec3 d = now.node[f][size_t(c.node)] - start.node[f][size_t(c.node)];
      w.drift = std::max(w.drift, std::hypot(d.x(), d.z()));
    }
  }
  return w;
}

// GLI of every pair of segments: jumps by one where a limb goes through a limb. [4 x 4]
inline MatX PairGlis(const RandomScene& s, const PostureSample& now) {
  return SegmentGliTable(s.subject.body[0], now.node[0], s.subject.body[1], now.node[1]);
}

}  // namespace retarget::solver
