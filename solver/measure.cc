#include "solver/measure.h"

#include <algorithm>
#include <cmath>

#include "model/capsule.h"
#include "model/path.h"
#include "model/so3.h"
#include "solver/terms/ground.h"
#include "solver/terms/penetration.h"

namespace retarget {
namespace {

constexpr int kSubSamples = 4;        // instants per frame interval
constexpr double kPassJump = 0.5;     // turns
constexpr double kPassReach = 0.6;    // m; further apart no pair can jump between instants
constexpr double kSlideSpeed = 0.01;  // m/s

struct Depth {
  double depth = 0;
  int node_1 = 0, node_2 = 0;
};

double DepthOf(const Body& body_1, const std::vector<Vec3>& p, int i, const Body& body_2,
               const std::vector<Vec3>& q, int j) {
  const double reach = body_1.nodes[i].radius + body_2.nodes[j].radius;
  const Vec3 &a = p[body_1.nodes[i].parent], &b = p[i], &c = q[body_2.nodes[j].parent], &d = q[j];
  const double bound = 0.5 * ((b - a).norm() + (d - c).norm()) + reach;
  if ((0.5 * (a + b - c - d)).squaredNorm() > bound * bound) return -1;
  return CapsuleDepth(ClosestPointsOfSegments(a, b, c, d), body_1.nodes[i].radius,
                      body_2.nodes[j].radius);
}

Depth DeepestBetween(const std::array<Body, 2>& body, const NodePositions& node) {
  Depth deepest;
  for (int i = 1; i < body[0].num_nodes(); ++i) {
    for (int j = 1; j < body[1].num_nodes(); ++j) {
      const double depth = DepthOf(body[0], node[0], i, body[1], node[1], j);
      if (depth > deepest.depth) deepest = {depth, i, j};
    }
  }
  return deepest;
}

double DeepestWithin(const Body& body, const std::vector<std::pair<int, int>>& pairs,
                     const std::vector<Vec3>& node) {
  double deepest = 0;
  for (const auto& [i, j] : pairs)
    deepest = std::max(deepest, DepthOf(body, node, i, body, node, j));
  return deepest;
}

class Measurement {
 public:
  Measurement(const MeasureSubject& subject, const MotionView& motion, const MotionView& source)
      : subject_(subject), motion_(motion), source_(source) {
    for (const HeldTangle& held : subject.tangles) {
      paths_.push_back({NodesOn(subject.body[0], held.tag.tangle.a),
                        NodesOn(subject.body[1], held.tag.tangle.b)});
    }
    for (int f = 0; f < 2; ++f) {
      self_pairs_[f] = SelfPairs(subject.body[f]);
      radius_[f] = NodeRadii(subject.body[f]);
    }
  }

  Metrics Run() {
    out_.tangles.assign(paths_.size(), {1e9, 1e9, 0, 0});
    out_.hold_m.assign(subject_.holds.size(), 0);
    out_.hold_frame.assign(subject_.holds.size(), 0);
    PostureSample previous, now;
    int frames_deep = 0, frames_kept = 0;
    for (int t = 0; t < motion_.num_frames; ++t) {
      for (int k = 0; k < (t + 1 < motion_.num_frames ? kSubSamples : 1); ++k) {
        motion_.at(t + static_cast<double>(k) / kSubSamples, &now);
        const bool on_frame = k == 0;
        const bool kept = MeasureTangles(now, t, on_frame);
        const bool deep = MeasurePenetration(now, t, on_frame);
        MeasureHolds(now, t);
        MeasureFigures(now, on_frame);
        if (on_frame) {
          frames_deep += deep;
          frames_kept += kept;
          frames_.push_back(now.node);
        }
        if (t > 0 || k > 0) {
          const GliJump jump = LargestGliJump(subject_.body, previous.node, now.node, kPassReach);
          if (jump.size > kPassJump) {
            const int frame = on_frame ? t - 1 : t;
            out_.pass_throughs.push_back({frame, jump.node_a, jump.node_b});
          }
        }
        std::swap(previous, now);
      }
    }
    out_.tangle_kept_percent = 100.0 * frames_kept / motion_.num_frames;
    out_.penetration_over_1cm_percent = 100.0 * frames_deep / motion_.num_frames;
    out_.smallest_gli = out_.smallest_gli_between = paths_.empty() ? 0 : 1e9;
    for (const TangleMetrics& t : out_.tangles) {
      out_.smallest_gli = std::min(out_.smallest_gli, t.min_signed_gli);
      out_.smallest_gli_between = std::min(out_.smallest_gli_between, t.min_signed_gli_between);
    }
    PostureSample sample;
    for (int t = 0; t < source_.num_frames; ++t) {
      source_.at(t, &sample);
      source_frames_.push_back(sample.node);
    }
    for (int f = 0; f < 2; ++f) {
      MeasureFeet(f);
      MeasureEdit(f);
    }
    MeasureJerk();
    return out_;
  }

 private:
  bool MeasureTangles(const PostureSample& now, int t, bool on_frame) {
    bool kept = true;
    for (size_t k = 0; k < paths_.size(); ++k) {
      const double gli =
          subject_.tangles[k].sign *
          PolylineGli(PointsOn(now.node[0], paths_[k][0]), PointsOn(now.node[1], paths_[k][1]));
      TangleMetrics& m = out_.tangles[k];
      m.min_signed_gli_between = std::min(m.min_signed_gli_between, gli);
      if (!on_frame) continue;
      if (gli < m.min_signed_gli) {
        m.min_signed_gli = gli;
        m.worst_frame = t;
      }
      if (gli <= kTangleThreshold) {
        ++m.frames_below_half;
        kept = false;
      }
    }
    return kept;
  }

  bool MeasurePenetration(const PostureSample& now, int t, bool on_frame) {
    const Depth deepest = DeepestBetween(subject_.body, now.node);
    if (deepest.depth > out_.penetration_between_m) {
      out_.penetration_between_m = deepest.depth;
      out_.penetration_frame = t;
      out_.penetration_node_a = deepest.node_1;
      out_.penetration_node_b = deepest.node_2;
    }
    if (on_frame) out_.penetration_m = std::max(out_.penetration_m, deepest.depth);
    return deepest.depth > 0.01;
  }

  void MeasureHolds(const PostureSample& now, int t) {
    const auto at = [&](const HoldPoint& p) -> Vec3 {
      if (p.figure == kWorld) return p.offset;
      return now.node[p.figure][p.node] + now.rotation[p.figure][p.node] * p.offset;
    };
    for (size_t k = 0; k < subject_.holds.size(); ++k) {
      const double error = (at(subject_.holds[k].from) - at(subject_.holds[k].to)).norm();
      if (error > out_.hold_m[k]) {
        out_.hold_m[k] = error;
        out_.hold_frame[k] = t;
      }
    }
  }

  void MeasureFigures(const PostureSample& now, bool on_frame) {
    for (int f = 0; f < 2; ++f) {
      const Body& body = subject_.body[f];
      FigureMetrics& m = out_.figure[f];
      for (int n = 0; n < body.num_nodes(); ++n) {
        m.floor_m = std::max(m.floor_m, radius_[f][n] - now.node[f][n].y());
      }
      for (int n = 1; n < body.num_nodes(); ++n) {
        if (body.nodes[n].name.find("shoulder") != std::string::npos) continue;
        const double length = subject_.length[f][n];
        const double is = (now.node[f][n] - now.node[f][body.nodes[n].parent]).norm();
        m.length_error_percent = std::max(m.length_error_percent, 100 * std::abs(is / length - 1));
      }
      if (on_frame) {
        m.self_penetration_m =
            std::max(m.self_penetration_m, DeepestWithin(body, self_pairs_[f], now.node[f]));
      }
    }
  }

  void MeasureFeet(int f) {
    FigureMetrics& m = out_.figure[f];
    int stance = 0, sliding = 0;
    for (const Contact& c : subject_.contacts[f]) {
      const Vec3 start = frames_[c.first][f][c.node];
      for (int t = c.first; t <= c.last; ++t) {
        const Vec3 d = frames_[t][f][c.node] - start;
        const double drift = std::hypot(d.x(), d.z());
        if (drift > m.foot_drift_m) {
          m.foot_drift_m = drift;
          m.foot_drift_frame = t;
        }
        if (t == c.first) continue;
        const double speed =
            (frames_[t][f][c.node] - frames_[t - 1][f][c.node]).norm() * motion_.fps;
        m.foot_speed_max = std::max(m.foot_speed_max, speed);
        ++stance;
        sliding += speed > kSlideSpeed;
      }
    }
    m.foot_speed_over_1cm_percent = stance > 0 ? 100.0 * sliding / stance : 0;
  }

  // Node distance to the source after taking out the root's place and the best-fitting yaw.
  void MeasureEdit(int f) {
    const Body& body = subject_.body[f];
    std::vector<char> tagged(body.nodes.size(), 0);
    for (const auto& path : paths_) {
      for (const int n : path[f]) tagged[n] = 1;
    }
    FigureMetrics& m = out_.figure[f];
    m.path_m.assign(body.nodes.size(), 0);
    double sum = 0;
    int count = 0;
    const int frames = std::min(motion_.num_frames, source_.num_frames);
    for (int t = 0; t < frames; ++t) {
      const std::vector<Vec3>&p = frames_[t][f], &q = source_frames_[t][f];
      double c = 0, s = 0;
      for (size_t n = 1; n < p.size(); ++n) {
        const Vec3 u = q[n] - q[0], v = p[n] - p[0];
        c += u.x() * v.x() + u.z() * v.z();
        s += u.z() * v.x() - u.x() * v.z();
      }
      const Quat yaw = YawRotation(std::atan2(s, c));
      for (size_t n = 1; n < p.size(); ++n) {
        if (!tagged[n]) {
          sum += ((p[n] - p[0]) - yaw * (q[n] - q[0])).norm();
          ++count;
        }
        if (t > 0) {
          m.path_m[n] += ((p[n] - p[0]) - (frames_[t - 1][f][n] - frames_[t - 1][f][0])).norm();
        }
      }
    }
    m.pose_error_cm = count > 0 ? 100 * sum / count : 0;
    m.joint_edit_deg = JointEdit(f, frames);
  }

  // Mean turn of the joints against the source (deg), over links that carry a node.
  double JointEdit(int f, int frames) const {
    const Body& body = subject_.body[f];
    PostureSample p, q;
    double sum = 0;
    int count = 0;
    for (int t = 0; t < frames; ++t) {
      motion_.at(t, &p);
      source_.at(t, &q);
      for (int n = 1; n < body.num_nodes(); ++n) {
        if (body.nodes[n].link == body.nodes[body.nodes[n].parent].link) continue;
        const int parent = body.nodes[n].parent;
        const Quat local_p = p.rotation[f][parent].conjugate() * p.rotation[f][n];
        const Quat local_q = q.rotation[f][parent].conjugate() * q.rotation[f][n];
        sum += LogSo3(local_q.conjugate() * local_p).norm() / kDegree;
        ++count;
      }
    }
    return count > 0 ? sum / count : 0;
  }

  static double MeanJerk(const std::vector<NodePositions>& frames, int f, double fps) {
    double sum = 0;
    int count = 0;
    for (size_t t = 0; t + 3 < frames.size(); ++t) {
      for (size_t n = 0; n < frames[t][f].size(); ++n) {
        sum += (frames[t + 3][f][n] - 3 * frames[t + 2][f][n] + 3 * frames[t + 1][f][n] -
                frames[t][f][n])
                   .norm();
        ++count;
      }
    }
    return count > 0 ? sum / count * fps * fps * fps : 0;
  }

  void MeasureJerk() {
    std::array<double, 2> source;
    for (int f = 0; f < 2; ++f) source[f] = MeanJerk(source_frames_, f, motion_.fps);
    const double larger = std::max(source[0], source[1]);
    for (int f = 0; f < 2; ++f) {
      FigureMetrics& m = out_.figure[f];
      m.jerk = MeanJerk(frames_, f, motion_.fps);
      m.jerk_ratio_own = source[f] > 0 ? m.jerk / source[f] : 1;
      m.jerk_ratio_larger = larger > 0 ? m.jerk / larger : 1;
    }
  }

  const MeasureSubject& subject_;
  const MotionView& motion_;
  const MotionView& source_;
  std::vector<std::array<std::vector<int>, 2>> paths_;
  std::array<std::vector<std::pair<int, int>>, 2> self_pairs_;
  std::array<std::vector<double>, 2> radius_;
  std::vector<NodePositions> frames_, source_frames_;
  Metrics out_;
};

}  // namespace

MotionView ViewOf(const std::array<Body, 2>& body, const std::array<Clip, 2>& clips) {
  MotionView view;
  view.num_frames = clips[0].num_frames();
  view.fps = clips[0].fps;
  view.at = [&body, &clips](double frame, PostureSample* sample) {
    for (int f = 0; f < 2; ++f) {
      const int last = clips[f].num_frames() - 1;
      const int k = std::clamp(static_cast<int>(frame), 0, last);
      const double u = frame - k;
      const PosedBody posed = PoseBody(
          body[f], u > 0 && k < last ? Interpolate(clips[f].frames[k], clips[f].frames[k + 1], u)
                                     : clips[f].frames[k]);
      sample->node[f] = posed.node;
      sample->rotation[f].clear();
      for (const Node& node : body[f].nodes) {
        sample->rotation[f].push_back(Quat(posed.rotation[node.link]));
      }
    }
  };
  return view;
}

MeasureSubject SubjectOf(const Scene& scene) {
  MeasureSubject subject{scene.body, {}, scene.tangles, scene.holds, scene.contacts};
  for (int f = 0; f < 2; ++f) {
    subject.length[f].push_back(0);
    for (int n = 1; n < scene.body[f].num_nodes(); ++n) {
      subject.length[f].push_back(scene.body[f].SegmentLength(n));
    }
  }
  return subject;
}

Metrics Measure(const MeasureSubject& subject, const MotionView& motion, const MotionView& source) {
  return Measurement(subject, motion, source).Run();
}

bool AllMet(const std::vector<RequirementCheck>& checks) {
  return std::all_of(checks.begin(), checks.end(), [](const RequirementCheck& c) { return c.met; });
}

std::vector<RequirementCheck> CheckRequirements(const MeasureSubject& subject, const Metrics& m,
                                                const Requirements& r) {
  const auto node = [&](int f, int n) { return subject.body[f].nodes[n].name; };
  const auto frame = [](int t) { return "frame " + std::to_string(t); };
  std::vector<RequirementCheck> checks;
  for (size_t k = 0; k < m.tangles.size(); ++k) {
    const Tangle& t = subject.tangles[k].tag.tangle;
    const double value = std::min(m.tangles[k].min_signed_gli, m.tangles[k].min_signed_gli_between);
    checks.push_back({"tangle " + std::to_string(k + 1), value, r.gli, "turns", value > r.gli,
                      "a (" + node(0, t.a.from) + ", " + node(0, t.a.to) + ") x b (" +
                          node(1, t.b.from) + ", " + node(1, t.b.to) + "), " +
                          frame(m.tangles[k].worst_frame)});
  }
  const double passes = static_cast<double>(m.pass_throughs.size());
  checks.push_back(
      {"pass-throughs", passes, static_cast<double>(r.pass_throughs), "", passes <= r.pass_throughs,
       m.pass_throughs.empty()
           ? ""
           : frame(m.pass_throughs[0].frame) + ", a " + node(0, m.pass_throughs[0].node_a) +
                 " through b " + node(1, m.pass_throughs[0].node_b)});
  const double deepest = std::max(m.penetration_m, m.penetration_between_m);
  checks.push_back({"penetration", deepest, r.penetration_m, "m", deepest <= r.penetration_m,
                    deepest > 0
                        ? frame(m.penetration_frame) + ", a " + node(0, m.penetration_node_a) +
                              " in b " + node(1, m.penetration_node_b)
                        : ""});
  checks.push_back({"penetration over 1 cm", m.penetration_over_1cm_percent,
                    r.penetration_1cm_percent, "% of frames",
                    m.penetration_over_1cm_percent <= r.penetration_1cm_percent, ""});
  for (int f = 0; f < 2; ++f) {
    const std::string who = f == 0 ? "a" : "b";
    checks.push_back({"foot drift " + who, m.figure[f].foot_drift_m, r.foot_drift_m, "m",
                      m.figure[f].foot_drift_m <= r.foot_drift_m,
                      frame(m.figure[f].foot_drift_frame)});
    checks.push_back({"floor " + who, m.figure[f].floor_m, r.floor_m, "m",
                      m.figure[f].floor_m <= r.floor_m, ""});
  }
  for (size_t k = 0; k < m.hold_m.size(); ++k) {
    checks.push_back({"hold " + std::to_string(k + 1), m.hold_m[k], r.hold_m, "m",
                      m.hold_m[k] <= r.hold_m, frame(m.hold_frame[k])});
  }
  return checks;
}

}  // namespace retarget
