#include "io/gltf/tracks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/bvh/bvh.h"
#include "io/text/quoted.h"

namespace retarget::io {
namespace {

// How far a rotation may be off unit length: what Khronos' validator grants, and what rounding to 8
// bits adds to it.
constexpr double kOffUnit = 0.00769, kOffUnitOfBytes = 0.016;
constexpr double kWorthANote = 1e-3;

// Between which keys a time lies, and where (0..1).
struct Span {
  size_t from = 0, to = 0;
  double u = 0;
  double seconds = 0;
};

Span SpanAt(const std::vector<double>& times, double time) {
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  Span span;
  if (after == times.begin()) return span;
  span.from = span.to = static_cast<size_t>(after - times.begin()) - 1;
  if (after == times.end()) return span;
  span.to = span.from + 1;
  span.seconds = times[span.to] - times[span.from];
  span.u = (time - times[span.from]) / span.seconds;
  return span;
}

// By the specification's formulas (glTF 2.0, appendix C). Quaternions are not yet normalised.
std::array<double, 4> ValueAt(const GltfTrack& track, double time) {
  const Span span = SpanAt(track.times, time);
  std::array<double, 4> out = {};
  const double* a = track.Key(span.from);
  const double* b = track.Key(span.to);
  for (size_t c = 0; c < track.width; ++c) {
    if (track.kind == GltfTrack::Kind::kStep || span.from == span.to) {
      out[c] = a[c];
    } else if (track.kind == GltfTrack::Kind::kLinear) {
      out[c] = (1 - span.u) * a[c] + span.u * b[c];
    } else {
      const double u = span.u, u2 = u * u, u3 = u2 * u;
      const double leaving = span.seconds * a[c + track.width];
      const double arriving = span.seconds * (b - track.width)[c];
      out[c] = (2 * u3 - 3 * u2 + 1) * a[c] + (u3 - 2 * u2 + u) * leaving +
               (3 * u2 - 2 * u3) * b[c] + (u3 - u2) * arriving;
    }
  }
  return out;
}

Quat ToQuat(const double* xyzw) { return Quat(xyzw[3], xyzw[0], xyzw[1], xyzw[2]); }

class TrackReader {
 public:
  TrackReader(const tinygltf::Animation& animation, GltfAccessors* accessors,
              const std::string& name, std::vector<std::string>* notes)
      : animation_(animation), accessors_(*accessors), name_(name), notes_(*notes) {}

  GltfTracks Read() {
    GltfTracks out;
    for (size_t c = 0; c < animation_.channels.size(); ++c) {
      const tinygltf::AnimationChannel& channel = animation_.channels[c];
      if (channel.target_node < 0) continue;
      const std::string& path = channel.target_path;
      std::map<int, GltfTrack>* tracks = path == "translation" ? &out.translation
                                         : path == "rotation"  ? &out.rotation
                                         : path == "scale"     ? &out.scale
                                                               : nullptr;
      if (tracks == nullptr) continue;
      place_ = fmt::format("channel {} ({} of node {})", c, path, channel.target_node);
      const auto [it, fresh] = tracks->emplace(channel.target_node, GltfTrack());
      if (!fresh) Fail("a second track for the same property");
      it->second = ReadTrack(animation_.samplers[channel.sampler], path == "rotation");
    }
    if (worst_off_unit_ > kWorthANote) {
      notes_.push_back(
          fmt::format("rotations up to {:.2g} off unit length were normalised", worst_off_unit_));
    }
    return out;
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw InputError(fmt::format("{}: animation \"{}\", {}: {}", name_, Printable(animation_.name),
                                 place_, what));
  }

  GltfTrack ReadTrack(const tinygltf::AnimationSampler& sampler, bool rotates) {
    GltfTrack track;
    track.width = rotates ? 4 : 3;
    if (sampler.interpolation == "STEP") {
      track.kind = GltfTrack::Kind::kStep;
    } else if (sampler.interpolation == "CUBICSPLINE") {
      track.kind = GltfTrack::Kind::kCubic;
    } else if (sampler.interpolation != "LINEAR") {
      Fail(fmt::format("interpolation \"{}\", expected LINEAR, STEP or CUBICSPLINE",
                       Printable(sampler.interpolation)));
    }
    track.times = KeyTimes(sampler.input);
    if (!accessors_.IsFloat(sampler.output) &&
        !(rotates && accessors_.IsNormalised(sampler.output))) {
      Fail("values must be floats, or normalised integers for a rotation");
    }
    const size_t per_key = track.kind == GltfTrack::Kind::kCubic ? 3 : 1;
    if (accessors_.Count(sampler.output) != per_key * track.times.size()) {
      Fail(fmt::format("{} values for {} keys, expected {}", accessors_.Count(sampler.output),
                       track.times.size(), per_key * track.times.size()));
    }
    track.values =
        accessors_.Read(sampler.output, rotates ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3);
    if (rotates) Normalise(accessors_.IsFloat(sampler.output) ? kOffUnit : kOffUnitOfBytes, &track);
    return track;
  }

  const std::vector<double>& KeyTimes(int accessor) {
    const auto known = times_.find(accessor);
    if (known != times_.end()) return known->second;
    if (!accessors_.IsFloat(accessor)) Fail("key times must be floats");
    std::vector<double> times = accessors_.Read(accessor, TINYGLTF_TYPE_SCALAR);
    if (times[0] < 0) Fail("key times begin before zero");
    for (size_t k = 1; k < times.size(); ++k) {
      if (times[k] <= times[k - 1]) Fail("key times do not ascend");
    }
    return times_.emplace(accessor, std::move(times)).first->second;
  }

  void Normalise(double tolerance, GltfTrack* track) {
    for (size_t k = 0; k < track->times.size(); ++k) {
      double* q = track->values.data() + (track->Key(k) - track->values.data());
      const double off = std::abs(ToQuat(q).norm() - 1);
      if (!(off <= tolerance)) Fail(fmt::format("key {} is no unit quaternion", k));
      worst_off_unit_ = std::max(worst_off_unit_, off);
      // A spline's formula wants the values as they are.
      if (track->kind == GltfTrack::Kind::kCubic) continue;
      const Eigen::Vector4d unit = Eigen::Map<Eigen::Vector4d>(q).normalized();
      Eigen::Map<Eigen::Vector4d>(q, 4) = unit;
    }
  }

  const tinygltf::Animation& animation_;
  GltfAccessors& accessors_;
  const std::string& name_;
  std::vector<std::string>& notes_;
  std::string place_;
  std::map<int, std::vector<double>> times_;  // by accessor: channels share them
  double worst_off_unit_ = 0;
};

}  // namespace

const double* GltfTrack::Key(size_t k) const {
  return values.data() + (kind == Kind::kCubic ? 3 * k + 1 : k) * width;
}

Vec3 GltfTrack::Translation(double time) const {
  const std::array<double, 4> v = ValueAt(*this, time);
  return Vec3(v[0], v[1], v[2]);
}

Quat GltfTrack::Rotation(double time) const {
  if (kind == Kind::kLinear) {
    const Span span = SpanAt(times, time);
    return ToQuat(Key(span.from)).slerp(span.u, ToQuat(Key(span.to))).normalized();
  }
  const std::array<double, 4> v = ValueAt(*this, time);
  const Quat q = ToQuat(v.data());
  // A spline through opposite values can pass the origin, where no direction is right.
  return q.norm() > 1e-9 ? q.normalized() : ToQuat(Key(SpanAt(times, time).from)).normalized();
}

bool GltfTrack::IsConstant(double tolerance) const {
  const bool spline = kind == Kind::kCubic;
  for (size_t k = 0; k < times.size(); ++k) {
    for (size_t c = 0; c < width; ++c) {
      if (std::abs(Key(k)[c] - Key(0)[c]) > tolerance) return false;
      if (spline && (Key(k)[c + width] != 0 || (Key(k) - width)[c] != 0)) return false;
    }
  }
  return true;
}

GltfTracks ReadTracks(const tinygltf::Animation& animation, GltfAccessors* accessors,
                      const std::string& name, std::vector<std::string>* notes) {
  return TrackReader(animation, accessors, name, notes).Read();
}

FrameTimes ChooseFrameTimes(const std::vector<const GltfTrack*>& tracks, const std::string& name) {
  constexpr double kHighestRate = 240, kSmoothRate = 30;
  constexpr double kSame = 1e-5;    // s: keys of different tracks that mean one instant
  constexpr double kOnGrid = 0.02;  // of a frame: what rounding to milliseconds shifts
  constexpr double kMostFrames = 1e6;
  FrameTimes out;
  std::vector<double> all;
  bool curved = false;
  for (const GltfTrack* track : tracks) {
    all.insert(all.end(), track->times.begin(), track->times.end());
    curved = curved || (track->kind != GltfTrack::Kind::kLinear && !track->IsConstant(0));
    if (all.size() < 4 * kMostFrames) continue;
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
  }
  std::sort(all.begin(), all.end());
  for (const double t : all) {
    if (out.times.empty() || t - out.times.back() > kSame) out.times.push_back(t);
  }
  if (out.times.empty()) out.times.push_back(0);
  out.are_keys = !tracks.empty();
  if (out.times.size() < 2) return out;

  const double begin = out.times.front(), span = out.times.back() - begin;
  const auto lie_on_grid = [&](double cell) {
    return std::all_of(out.times.begin(), out.times.end(), [&](double t) {
      return std::abs(std::remainder(t - begin, cell)) <= kOnGrid * cell;
    });
  };
  double step = span / static_cast<double>(out.times.size() - 1);
  bool even = true;
  for (size_t k = 1; k < out.times.size() && even; ++k) {
    even = std::abs(out.times[k] - begin - static_cast<double>(k) * step) <= kOnGrid * step;
  }
  if (!even) {
    step = span;
    for (size_t k = 1; k < out.times.size(); ++k) {
      step = std::min(step, out.times[k] - out.times[k - 1]);
    }
  }
  step = SnappedFrameTime(step);
  const bool too_fast = step < (1 - kOnGrid) / kHighestRate;
  // Where keys lie uneven, a finer grid may still meet them all: then nothing is lost.
  for (int finer = 2; !even && !lie_on_grid(step); ++finer) {
    if (finer > kHighestRate * step * (1 + kOnGrid)) break;
    if (lie_on_grid(step / finer)) step /= finer;
  }
  step = std::max(step, 1 / kHighestRate);
  const bool refine = curved && 1 / step < kSmoothRate * (1 - 1e-3);
  if (refine) step /= std::ceil(kSmoothRate * step * (1 - 1e-3));
  out.frame_time = step;
  if (even && !refine && !too_fast) return out;

  out.are_keys = false;
  const double count = std::ceil(span / step - kOnGrid) + 1;
  if (count > kMostFrames) {
    throw InputError(
        fmt::format("{}: the animation lasts {:.0f} s, too long for {:.0f} frames per "
                    "second",
                    name, span, 1 / step));
  }
  out.times.clear();
  for (double k = 0; k < count; ++k) out.times.push_back(begin + k * step);
  return out;
}

}  // namespace retarget::io
