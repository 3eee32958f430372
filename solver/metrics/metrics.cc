#include "solver/metrics/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "model/geometry/so3.h"
#include "solver/metrics/hand_metrics.h"

namespace retarget::solver {
namespace {

constexpr double kDeep = 0.01;        // m
constexpr double kSlideSpeed = 0.01;  // m/s

// The metrics are extremes, shares and means of the series.
class Measurement {
 public:
  Measurement(const MetricsContext& subject, const FrameMetrics& series,
              const std::vector<NodePositions>& source)
      : subject_(subject), series_(series), frames_(series.node), source_frames_(source) {}

  Metrics Run() {
    MeasureTangles();
    MeasureExtremes();
    out_.pass_throughs = series_.pass_throughs;
    for (int f = 0; f < 2; ++f) {
      MeasureFeet(f);
      MeasureEdit(f);
      out_.figure[f].holding_hand_gap_m = HoldingHandGap(subject_, f, frames_);
    }
    MeasureJerk();
    return out_;
  }

 private:
  void MeasureTangles() {
    const double none = std::numeric_limits<double>::max();
    out_.tangles.assign(subject_.tangles.size(), {none, none, 0, 0});
    if (out_.tangles.empty()) return;
    int kept = 0;
    for (int t = 0; t < series_.num_frames(); ++t) {
      bool all = true;
      for (size_t k = 0; k < out_.tangles.size(); ++k) {
        TangleMetrics& m = out_.tangles[k];
        const double gli = series_.at[t].gli[k];
        if (gli < m.min_signed_gli) {
          m.min_signed_gli = gli;
          m.worst_frame = t;
        }
        m.min_signed_gli_between = std::min(m.min_signed_gli_between, gli);
        if (t + 1 < series_.num_frames()) {
          m.min_signed_gli_between = std::min(m.min_signed_gli_between, series_.between[t].gli[k]);
        }
        if (gli > kTangleThreshold) continue;
        ++m.frames_below_half;
        all = false;
      }
      kept += all;
    }
    out_.tangle_kept_percent = 100.0 * kept / series_.num_frames();
    out_.smallest_gli = out_.smallest_gli_between = none;
    for (const TangleMetrics& t : out_.tangles) {
      out_.smallest_gli = std::min(out_.smallest_gli, t.min_signed_gli);
      out_.smallest_gli_between = std::min(out_.smallest_gli_between, t.min_signed_gli_between);
    }
  }

  void MeasureExtremes() {
    out_.hold_m.assign(subject_.holds.size(), 0);
    out_.hold_frame.assign(subject_.holds.size(), 0);
    int deep = 0;
    for (int t = 0; t < series_.num_frames(); ++t) {
      Include(series_.at[t], t);
      if (t + 1 < series_.num_frames()) Include(series_.between[t], t);
      const double depth = series_.at[t].penetration.depth_m;
      out_.penetration_m = std::max(out_.penetration_m, depth);
      deep += depth > kDeep;
    }
    out_.penetration_over_1cm_percent = 100.0 * deep / series_.num_frames();
  }

  // Takes the extremes of one instant, or of those between frame t and the next.
  void Include(const InstantMetrics& values, int t) {
    if (values.penetration.depth_m > out_.penetration_between_m) {
      out_.penetration_between_m = values.penetration.depth_m;
      out_.penetration_frame = t;
      out_.penetration_node_a = values.penetration.node_1;
      out_.penetration_node_b = values.penetration.node_2;
    }
    for (size_t k = 0; k < out_.hold_m.size(); ++k) {
      if (values.hold_m[k] <= out_.hold_m[k]) continue;
      out_.hold_m[k] = values.hold_m[k];
      out_.hold_frame[k] = t;
    }
    for (int f = 0; f < 2; ++f) {
      const FigureValues& v = values.figure[f];
      FigureMetrics& m = out_.figure[f];
      m.self_penetration_m = std::max(m.self_penetration_m, v.self_penetration.depth_m);
      m.length_error_percent = std::max(m.length_error_percent, v.length_error_percent);
      if (v.floor_m <= m.floor_m) continue;
      m.floor_m = v.floor_m;
      m.floor_frame = t;
      m.floor_node = v.floor_node;
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
        if (std::isnan(m.foot_drift_m) || drift > m.foot_drift_m) {
          m.foot_drift_m = drift;
          m.foot_drift_frame = t;
          m.foot_drift_node = c.node;
        }
        if (t == c.first) continue;
        const double speed = PlantedSpeed(series_, f, c, t);
        m.foot_speed_max = std::fmax(m.foot_speed_max, speed);
        ++stance;
        sliding += speed > kSlideSpeed;
      }
    }
    if (stance > 0) m.foot_speed_over_1cm_percent = 100.0 * sliding / stance;
    m.swings = MeasureSwings(subject_, f, frames_, source_frames_);
    m.edges = MeasureEdges(subject_, f, series_.fps, frames_, source_frames_);
  }

  // Node distance to the source after taking out the root's place and the best-fitting yaw.
  void MeasureEdit(int f) {
    const std::vector<int> untagged = UntaggedNodes(subject_, f);
    FigureMetrics& m = out_.figure[f];
    m.path_m.assign(subject_.body[f].nodes.size(), 0);
    double sum = 0;
    int count = 0;
    const size_t frames = std::min(frames_.size(), source_frames_.size());
    for (size_t t = 0; t < frames; ++t) {
      const std::vector<Vec3>&p = frames_[t][f], &q = source_frames_[t][f];
      const Quat yaw = YawRotation(BestYaw(q, p));
      for (const int n : untagged) {
        sum += ((p[n] - p[0]) - yaw * (q[n] - q[0])).norm();
        ++count;
      }
      for (size_t n = 1; n < p.size() && t > 0; ++n) {
        m.path_m[n] += ((p[n] - p[0]) - (frames_[t - 1][f][n] - frames_[t - 1][f][0])).norm();
      }
    }
    if (count > 0) m.pose_error_cm = 100 * sum / count;
    m.joint_edit_deg = JointEdit(f, frames);
    m.plausible = MeasurePlausibility(subject_, f, series_, source_frames_);
  }

  // Mean turn of the joints against the source (deg).
  double JointEdit(int f, size_t frames) const {
    double sum = 0;
    for (const std::vector<double>& joint : series_.tracking_deg[f]) {
      sum = std::accumulate(joint.begin(), joint.begin() + static_cast<long>(frames), sum);
    }
    const size_t count = frames * series_.tracking_deg[f].size();
    return count > 0 ? sum / static_cast<double>(count) : kNothingMeasured;
  }

  void MeasureJerk() {
    std::array<double, 2> source;
    for (int f = 0; f < 2; ++f) source[f] = MeanJerk(source_frames_, f, series_.fps);
    const double larger = std::max(source[0], source[1]);
    for (int f = 0; f < 2; ++f) {
      FigureMetrics& m = out_.figure[f];
      m.jerk = MeanJerk(frames_, f, series_.fps);
      if (source[f] > 0) m.jerk_ratio_own = m.jerk / source[f];
      if (larger > 0) m.jerk_ratio_larger = m.jerk / larger;
    }
  }

  const MetricsContext& subject_;
  const FrameMetrics& series_;
  const std::vector<NodePositions>&frames_, &source_frames_;
  Metrics out_;
};

}  // namespace

const Swing* WorstSwing(const FigureMetrics& metrics) {
  const auto excess = [](const Swing& s) { return s.travel_m - s.source_m; };
  const auto worst =
      std::max_element(metrics.swings.begin(), metrics.swings.end(),
                       [&](const Swing& s, const Swing& t) { return excess(s) < excess(t); });
  return worst == metrics.swings.end() ? nullptr : &*worst;
}

const ContactEdge* WorstEdge(const FigureMetrics& metrics) {
  const auto ratio = [](const ContactEdge& e) {
    return e.acceleration / std::max(e.source, kLeastEdge);
  };
  const auto worst = std::max_element(
      metrics.edges.begin(), metrics.edges.end(),
      [&](const ContactEdge& e, const ContactEdge& g) { return ratio(e) < ratio(g); });
  return worst == metrics.edges.end() ? nullptr : &*worst;
}

Metrics MetricsOf(const MetricsContext& subject, const FrameMetrics& series,
                  const std::vector<NodePositions>& source) {
  return Measurement(subject, series, source).Run();
}

Metrics Measure(const MetricsContext& subject, const MotionView& motion, const MotionView& source) {
  return MetricsOf(subject, MeasureFrames(subject, motion, source), NodesOf(source));
}

}  // namespace retarget::solver
