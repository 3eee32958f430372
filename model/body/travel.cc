#include "model/body/travel.h"

#include <algorithm>
#include <cmath>

#include "model/body/contact.h"
#include "model/geometry/quantile.h"

namespace retarget {
namespace {

constexpr double kStanceHeight = 0.012;  // m: a foot node so far over its lowest counts 1/e
constexpr double kLeastStance = 0.1;     // of these weights: less, and no foot stands
constexpr double kBlur = 0.06;           // s, of the treadmill's speed
constexpr int kRefinements = 3;
// What is clear (see the header).
constexpr double kSlides = 0.3;            // m/s
constexpr double kStandsAsCaptured = 0.1;  // share of frames with a planted foot, at most
constexpr double kRootShare = 0.25;        // of the recovered way, that the root goes by itself
constexpr double kStandsRecovered = 0.25;  // share of frames with a planted foot, at least

Vec3 Horizontal(const Vec3& v) { return Vec3(v.x(), 0, v.z()); }

using FootPath = std::vector<Vec3>;  // of one foot node, per frame

// Share of the frames in which some foot is planted.
double StanceShare(const std::vector<FootPath>& feet, double fps, const ContactSettings& settings) {
  std::vector<char> stands(feet[0].size(), 0);
  for (const FootPath& foot : feet) {
    for (const Contact& c : DetectContacts(foot, fps, 0, settings)) {
      std::fill(stands.begin() + c.first, stands.begin() + c.last + 1, 1);
    }
  }
  return static_cast<double>(std::count(stands.begin(), stands.end(), 1)) /
         static_cast<double>(stands.size());
}

double FifthPercentileHeight(const FootPath& foot) {
  std::vector<double> height;
  for (const Vec3& p : foot) height.push_back(p.y());
  return Quantile(std::move(height), 0.05);
}

Vec3 Velocity(const FootPath& foot, int t, double fps) {
  const int before = std::max(t - 1, 0);
  const int after = std::min(t + 1, static_cast<int>(foot.size()) - 1);
  return Horizontal(foot[after] - foot[before]) * fps / std::max(1, after - before);
}

// Velocity of what stands on the floor (m/s), per frame, and how surely something stands.
struct Treadmill {
  std::vector<Vec3> velocity;
  std::vector<double> weight;
  std::vector<double> lowest_speed;  // of the lowest node
};

Treadmill TreadmillOf(const std::vector<FootPath>& feet, double fps) {
  Treadmill out;
  std::vector<double> floor;
  for (const FootPath& foot : feet) floor.push_back(FifthPercentileHeight(foot));
  for (int t = 0; t < static_cast<int>(feet[0].size()); ++t) {
    Vec3 sum = Vec3::Zero();
    double weights = 0, lowest = 1e300, speed = 0;
    for (size_t k = 0; k < feet.size(); ++k) {
      const double height = feet[k][t].y() - floor[k];
      const double w = std::exp(-std::max(height, 0.0) / kStanceHeight);
      const Vec3 v = Velocity(feet[k], t, fps);
      sum += w * v;
      weights += w;
      if (height < lowest) {
        lowest = height;
        speed = v.norm();
      }
    }
    out.velocity.emplace_back(weights > 0 ? Vec3(sum / weights) : Vec3::Zero());
    out.weight.push_back(weights < kLeastStance ? 0 : weights);
    out.lowest_speed.push_back(speed);
  }
  return out;
}

// Weighted Gaussian mean in time; frames in which nothing stands take their neighbours' value.
std::vector<Vec3> Smoothed(const Treadmill& treadmill, double fps) {
  const int n = static_cast<int>(treadmill.velocity.size());
  std::vector<Vec3> out(static_cast<size_t>(n), Vec3::Zero());
  for (int t = 0; t < n; ++t) {
    for (double blur = kBlur; blur < 100; blur *= 2) {
      const int reach = static_cast<int>(std::ceil(3 * blur * fps));
      Vec3 sum = Vec3::Zero();
      double weights = 0;
      for (int s = std::max(0, t - reach); s <= std::min(n - 1, t + reach); ++s) {
        const double d = (s - t) / (blur * fps);
        const double w = treadmill.weight[s] * std::exp(-0.5 * d * d);
        sum += w * treadmill.velocity[s];
        weights += w;
      }
      if (weights < kLeastStance) continue;
      out[t] = sum / weights;
      break;
    }
  }
  return out;
}

std::vector<Vec3> OffsetOf(const Treadmill& treadmill, double fps) {
  const std::vector<Vec3> velocity = Smoothed(treadmill, fps);
  std::vector<Vec3> offset = {Vec3::Zero()};
  for (size_t t = 1; t < velocity.size(); ++t) {
    offset.emplace_back(offset.back() - 0.5 * (velocity[t - 1] + velocity[t]) / fps);
  }
  return offset;
}

std::vector<FootPath> Moved(std::vector<FootPath> feet, const std::vector<Vec3>& offset) {
  for (FootPath& foot : feet) {
    for (size_t t = 0; t < foot.size(); ++t) foot[t] += offset[t];
  }
  return feet;
}

// The treadmill under the nodes that are planted once the feet are moved by `offset`.
Treadmill PlantedOnly(const Treadmill& all, const std::vector<FootPath>& feet,
                      const std::vector<Vec3>& offset, double fps,
                      const ContactSettings& settings) {
  Treadmill out = all;
  const size_t frames = offset.size();
  out.weight.assign(frames, 0);
  out.velocity.assign(frames, Vec3::Zero());
  const std::vector<FootPath> moved = Moved(feet, offset);
  for (size_t k = 0; k < feet.size(); ++k) {
    for (const Contact& c : DetectContacts(moved[k], fps, 0, settings)) {
      for (int t = c.first + 1; t < c.last; ++t) {  // at its ends it still moves
        out.velocity[t] += Velocity(feet[k], t, fps);
        ++out.weight[t];
      }
    }
  }
  for (size_t t = 0; t < frames; ++t) {
    if (out.weight[t] > 0) out.velocity[t] /= out.weight[t];
  }
  return out;
}

}  // namespace

Travel FindTravel(const Body& body, const Clip& clip, const ContactSettings& settings) {
  Travel travel;
  const std::vector<int> nodes = FootNodes(body);
  if (nodes.empty() || clip.num_frames() < 3) return travel;
  std::vector<FootPath> feet(nodes.size());
  PosedBody posed;
  for (const Pose& pose : clip.frames) {
    PoseBody(body, pose, &posed);
    for (size_t k = 0; k < nodes.size(); ++k) feet[k].push_back(posed.node[nodes[k]]);
  }
  const Treadmill treadmill = TreadmillOf(feet, clip.fps);
  travel.sliding_speed = Median(treadmill.lowest_speed);
  if (travel.sliding_speed < kSlides || StanceShare(feet, clip.fps, settings) > kStandsAsCaptured) {
    return travel;
  }
  std::vector<Vec3> offset = OffsetOf(treadmill, clip.fps);
  for (int pass = 0; pass < kRefinements; ++pass) {
    // Now that the feet come to rest, only what is planted says how fast the treadmill is: a foot
    // that is about to leave is already slower or faster.
    const Treadmill planted = PlantedOnly(treadmill, feet, offset, clip.fps, settings);
    if (std::all_of(planted.weight.begin(), planted.weight.end(),
                    [](double w) { return w == 0; })) {
      return travel;
    }
    offset = OffsetOf(planted, clip.fps);
  }
  double way = 0;
  for (size_t t = 1; t < offset.size(); ++t) way += (offset[t] - offset[t - 1]).norm();
  const Vec3 root = Horizontal(clip.frames.back().root_position - clip.frames[0].root_position);
  if (root.norm() > kRootShare * way ||
      StanceShare(Moved(feet, offset), clip.fps, settings) < kStandsRecovered) {
    return travel;
  }
  travel.offset = std::move(offset);
  travel.speed = way * clip.fps / static_cast<double>(clip.num_frames() - 1);
  return travel;
}

}  // namespace retarget
