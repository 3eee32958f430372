#include "io/render/render.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

#include "io/render/capsule_light.h"
#include "io/render/capsule_mesh.h"

namespace retarget::io {
namespace {

// ---- Look. Light and colour are linear here; 1 is white on the screen.
constexpr double kKeyLight = 0.80;
constexpr double kSkyLight = 0.52;
constexpr double kFloorLight = 0.30;                      // what the floor sends back up
constexpr double kFloorBright = 0.80, kFloorDark = 0.66;  // reflectance of the squares
constexpr double kOutline = 0.45;     // reflectance left where the view only grazes
constexpr double kGloss = 0.09;       // strength of the key light's reflection
constexpr double kSurfaceGap = 2e-3;  // shadows start this far off the surface (m)
constexpr int kEdgeSamples = 4;       // along each side of a pixel
const Vec3 kBackground(0.93, 0.945, 0.96), kFloorTint(0.985, 0.995, 1.0);

// Pixels to rays and back.
class Lens {
 public:
  Lens(const RenderCamera& camera, int width, int height)
      : eye_(camera.eye), width_(width), height_(height) {
    assert((camera.target - camera.eye).norm() > 0);
    ahead_ = (camera.target - camera.eye).normalized();
    const Vec3 top = std::abs(ahead_.y()) < 0.9999 ? Vec3::UnitY() : Vec3(-Vec3::UnitZ());
    right_ = ahead_.cross(top).normalized();
    up_ = right_.cross(ahead_);
    pixels_ = 0.5 * height / std::tan(0.5 * camera.fov_y_rad);
  }

  const Vec3& eye() const { return eye_; }
  // Level unit vectors to the right and towards the eye.
  const Vec3& right() const { return right_; }
  Vec3 Towards() const { return right_.cross(Vec3::UnitY()); }

  // Unit direction through the picture at (x, y), in pixels from the upper left corner.
  Vec3 Direction(double x, double y) const {
    return (pixels_ * ahead_ + (x - 0.5 * width_) * right_ - (y - 0.5 * height_) * up_)
        .normalized();
  }

  // A box {left, right, top, bottom} in pixels that holds the picture of the solid: that of the
  // cubes round its end spheres. The whole picture where one of them reaches behind the eye.
  std::array<double, 4> BoxOf(const Solid& s) const {
    std::array<double, 4> box = {kFar, -kFar, kFar, -kFar};
    for (const Vec3& end : {s.a, s.PointAt(s.length)}) {
      const Vec3 p = end - eye_;
      const double depth = p.dot(ahead_);
      if (depth - s.radius < 1e-3) {
        return {0.0, double(width_), 0.0, double(height_)};
      }
      for (const double d : {depth - s.radius, depth + s.radius}) {
        for (const double r : {-s.radius, s.radius}) {
          const double x = 0.5 * width_ + pixels_ * (p.dot(right_) + r) / d;
          const double y = 0.5 * height_ - pixels_ * (p.dot(up_) + r) / d;
          box = {std::min(box[0], x), std::max(box[1], x), std::min(box[2], y),
                 std::max(box[3], y)};
        }
      }
    }
    return box;
  }

 private:
  Vec3 eye_, ahead_, right_, up_;
  int width_, height_;
  double pixels_;  // distance of the picture plane
};

std::vector<Solid> SolidsOf(const std::vector<RenderCapsule>& capsules) {
  std::vector<Solid> solids;
  for (const RenderCapsule& c : capsules) {
    solids.emplace_back(c.a, c.b, c.radius, c.colour.unaryExpr(&LinearFromSrgb));
  }
  return solids;
}

// What a ray meets. Neighbouring pixels with different surfaces have an edge between them.
struct Sample {
  Vec3 light = Vec3::Zero();  // linear
  int surface = kSky;         // index of a capsule, or one of these:
  static constexpr int kSky = -1, kBrightTile = -2, kDarkTile = -3;
};

// What reaches a surface from the key light and from everywhere else.
struct Light {
  double key = 0, sky = 0;
};

class Renderer {
 public:
  Renderer(const std::vector<RenderCapsule>& capsules, const RenderCamera& camera, int width,
           int height, const RenderStyle& style)
      : width_(width),
        height_(height),
        style_(style),
        lens_(camera, width, height),
        solids_(SolidsOf(capsules)),
        light_((style.light.x() * lens_.right() + style.light.y() * Vec3::UnitY() +
                style.light.z() * lens_.Towards())
                   .normalized()),
        shadow_grid_(solids_, light_, kLightSpread * kShadowReach),
        sky_grid_(solids_, Vec3::UnitY(), kDimReach),
        fade_start_(2.0 * (camera.target - camera.eye).norm()) {
    SortIntoBlocks();
  }

  Image Render() const {
    std::vector<Sample> samples;
    samples.reserve(static_cast<size_t>(width_) * height_);
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) samples.push_back(Trace(x + 0.5, y + 0.5, BlockAt(x, y)));
    }
    Image image{width_, height_, std::vector<unsigned char>(3 * samples.size())};
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const Vec3 light = IsEdge(samples, x, y)
                               ? Smoothed(x, y)
                               : samples[static_cast<size_t>(y) * width_ + x].light;
        for (int c = 0; c < 3; ++c) {
          const double srgb = SrgbFromLinear(std::clamp(light[c], 0.0, 1.0));
          image.At(x, y)[c] = static_cast<unsigned char>(std::lround(255.0 * srgb));
        }
      }
    }
    return image;
  }

 private:
  static constexpr int kBlock = 16;  // pixels

  // The solids that may be seen in each block of kBlock x kBlock pixels.
  void SortIntoBlocks() {
    blocks_across_ = (width_ + kBlock - 1) / kBlock;
    const int blocks_down = (height_ + kBlock - 1) / kBlock;
    blocks_.resize(static_cast<size_t>(blocks_across_) * blocks_down);
    const auto block = [](double x, int count) {
      return static_cast<int>(std::clamp(std::floor(x / kBlock), -1.0, double(count)));
    };
    for (int i = 0; i < static_cast<int>(solids_.size()); ++i) {
      const auto [left, right, top, bottom] = lens_.BoxOf(solids_[i]);
      const int last_x = std::min(block(right, blocks_across_), blocks_across_ - 1);
      const int last_y = std::min(block(bottom, blocks_down), blocks_down - 1);
      for (int y = std::max(0, block(top, blocks_down)); y <= last_y; ++y) {
        for (int x = std::max(0, block(left, blocks_across_)); x <= last_x; ++x) {
          blocks_[static_cast<size_t>(y) * blocks_across_ + x].push_back(i);
        }
      }
    }
  }

  const std::vector<int>& BlockAt(int x, int y) const {
    return blocks_[static_cast<size_t>(y / kBlock) * blocks_across_ + x / kBlock];
  }

  bool IsEdge(const std::vector<Sample>& samples, int x, int y) const {
    const auto surface = [&](int px, int py) {
      return samples[static_cast<size_t>(py) * width_ + px].surface;
    };
    const int here = surface(x, y);
    for (int ny = std::max(0, y - 1); ny <= std::min(height_ - 1, y + 1); ++ny) {
      for (int nx = std::max(0, x - 1); nx <= std::min(width_ - 1, x + 1); ++nx) {
        if (surface(nx, ny) != here) return true;
      }
    }
    return false;
  }

  Vec3 Smoothed(int x, int y) const {
    Vec3 sum = Vec3::Zero();
    for (int j = 0; j < kEdgeSamples; ++j) {
      for (int i = 0; i < kEdgeSamples; ++i) {
        const Sample sample =
            Trace(x + (i + 0.5) / kEdgeSamples, y + (j + 0.5) / kEdgeSamples, BlockAt(x, y));
        sum += sample.light.cwiseMin(1.0);  // a bright spot must not outweigh its neighbours
      }
    }
    return sum / (kEdgeSamples * kEdgeSamples);
  }

  Sample Trace(double x, double y, const std::vector<int>& candidates) const {
    const Vec3 direction = lens_.Direction(x, y);
    double nearest = kFar;
    int hit = -1;
    for (const int i : candidates) {
      const double t = HitSolid(lens_.eye(), direction, solids_[i]);
      if (t < nearest) nearest = t, hit = i;
    }
    if (style_.floor && direction.y() < 0 && lens_.eye().y() > 0) {
      const double t = -lens_.eye().y() / direction.y();
      if (t < nearest) return ShadeFloor(direction, t);
    }
    if (hit < 0) return {kBackground, Sample::kSky};
    return {ShadeSolid(hit, direction, nearest), hit};
  }

  Sample ShadeFloor(const Vec3& direction, double t) const {
    const double seen = 1.0 - SmoothStep(fade_start_, 2.5 * fade_start_, t);
    if (seen <= 0) return {kBackground, Sample::kSky};
    const Vec3 p = lens_.eye() + t * direction;
    const auto odd = [&](double v) {
      return std::abs(std::fmod(std::floor(v / style_.tile + 0.5), 2.0)) > 0.5;
    };
    const bool dark = odd(p.x()) != odd(p.z());
    const Light light = LightAt(p, Vec3::UnitY(), -1);
    const double grey = (light.key + light.sky) * (dark ? kFloorDark : kFloorBright);
    const Vec3 colour = seen * grey * kFloorTint + (1.0 - seen) * kBackground;
    return {colour, dark ? Sample::kDarkTile : Sample::kBrightTile};
  }

  Vec3 ShadeSolid(int i, const Vec3& direction, double t) const {
    const Solid& s = solids_[i];
    const Vec3 p = lens_.eye() + t * direction;
    const Vec3 n = (p - s.Nearest(p)).normalized();
    // Darker where the view grazes, so that limbs in front of one another stay apart.
    const double rim = kOutline + (1.0 - kOutline) * SmoothStep(0.0, 0.5, -n.dot(direction));
    const Vec3 half = (light_ - direction).normalized();
    const double gloss = kGloss * std::pow(std::max(0.0, n.dot(half)), 40.0);
    const Light light = LightAt(p, n, i);
    return rim * ((light.key + light.sky) * s.reflectance + Vec3::Constant(light.key * gloss));
  }

  // Light that reaches a point p of surface `self` with normal n. A convex solid neither shades
  // nor dims itself.
  Light LightAt(const Vec3& p, const Vec3& n, int self) const {
    double sky = 1.0;
    for (const int i : sky_grid_.Near(p)) {
      if (i != self) sky *= SkyPast(solids_[i], p, n);
    }
    double key = std::max(0.0, n.dot(light_));
    if (key > 0) {
      const Vec3 start = p + kSurfaceGap * n;
      for (const int i : shadow_grid_.Near(p)) {
        if (i != self) key *= LightPast(solids_[i], start, light_);
        if (key <= 0) break;
      }
    }
    const double up = 0.5 + 0.5 * n.y();
    return {kKeyLight * key, (kSkyLight * up + kFloorLight * (1.0 - up)) * sky};
  }

  int width_, height_;
  RenderStyle style_;
  Lens lens_;
  std::vector<Solid> solids_;
  Vec3 light_;  // unit direction to the key light
  ColumnGrid shadow_grid_, sky_grid_;
  double fade_start_;  // distance at which the floor begins to fade into the background (m)
  int blocks_across_ = 0;
  std::vector<std::vector<int>> blocks_;
};

}  // namespace

Image RenderCapsules(const std::vector<RenderCapsule>& capsules, const RenderCamera& camera,
                     int width, int height, const RenderStyle& style) {
  assert(width > 0 && height > 0);
  return Renderer(capsules, camera, width, height, style).Render();
}

}  // namespace retarget::io
