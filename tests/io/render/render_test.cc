// The picture maker: what a pixel shows, symmetry, and the PNG as another decoder reads it.
#include "io/render/render.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <stdexcept>

#include "io/render/capsule_light.h"
#include "model/geometry/so3.h"

namespace retarget::io {
namespace {

const Vec3 kRed(0.9, 0.1, 0.1), kBlue(0.1, 0.2, 0.9);

Solid RandomSolid(std::mt19937* random) {
  std::uniform_real_distribution<double> at(-1.0, 1.0), size(0.05, 0.4);
  const Vec3 a(at(*random), at(*random), at(*random)), b(at(*random), at(*random), at(*random));
  return Solid(a, b, size(*random), kRed);
}

TEST(HitSolid, MeetsTheSurfaceFirst) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-1.2, 1.2);
  int hits = 0, misses = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Solid s = RandomSolid(&random);
    const Vec3 origin(at(random), at(random), 5.0);
    const Vec3 direction = (Vec3(at(random), at(random), 0) - origin).normalized();
    const auto gap = [&](double t) {
      const Vec3 p = origin + t * direction;
      return (p - s.Nearest(p)).norm() - s.radius;
    };
    const double t = HitSolid(origin, direction, s);
    ++(t < kFar ? hits : misses);
    if (t < kFar) {
      ASSERT_NEAR(gap(t), 0.0, 1e-9);
    }
    // Nothing of it comes earlier.
    for (double u = 0; u < std::min(t, 8.0) - 1e-6; u += 0.02) ASSERT_GT(gap(u), -1e-9);
  }
  EXPECT_GT(hits, 300);
  EXPECT_GT(misses, 300);
}

TEST(HitSolid, MeetsEndsAlongTheAxisAndSpheres) {
  const Solid s(Vec3(0, 0, -1), Vec3(0, 0, 1), 0.25, kRed);
  EXPECT_NEAR(HitSolid(Vec3(0, 0, 5), -Vec3::UnitZ(), s), 3.75, 1e-12);
  EXPECT_NEAR(HitSolid(Vec3(0, 0, -5), Vec3::UnitZ(), s), 3.75, 1e-12);
  EXPECT_EQ(HitSolid(Vec3(0, 0, 5), Vec3::UnitZ(), s), kFar) << "behind the ray";
  EXPECT_EQ(HitSolid(Vec3(0.3, 0, 5), -Vec3::UnitZ(), s), kFar);
  const Solid sphere(Vec3::Zero(), Vec3::Zero(), 0.5, kRed);
  EXPECT_NEAR(HitSolid(Vec3(0, 3, 0), -Vec3::UnitY(), sphere), 2.5, 1e-12);
}

TEST(LightPast, IsNoneBehindAllBesideAndHalfAtTheEdge) {
  const Solid s(Vec3(-1, 1, 0), Vec3(1, 1, 0), 0.1, kRed);
  EXPECT_EQ(LightPast(s, Vec3(0, 0, 0), Vec3::UnitY()), 0.0);
  EXPECT_EQ(LightPast(s, Vec3(0, 0, 0.5), Vec3::UnitY()), 1.0);
  EXPECT_NEAR(LightPast(s, Vec3(0, 0, 0.1), Vec3::UnitY()), 0.5, 1e-9);
  EXPECT_EQ(LightPast(s, Vec3(0, 2, 0), Vec3::UnitY()), 1.0) << "the solid is behind";
  double before = 0;
  for (double z = 0; z < 0.3; z += 0.01) {
    const double now = LightPast(s, Vec3(0, 0, z), Vec3::UnitY());
    EXPECT_GE(now, before);
    before = now;
  }
}

// Every solid that a column through p can meet is in the cell of p.
TEST(ColumnGrid, LeavesNothingOut) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(-1.5, 1.5);
  std::vector<Solid> solids;
  for (int i = 0; i < 20; ++i) solids.push_back(RandomSolid(&random));
  const Vec3 direction = Vec3(0.3, 1, -0.2).normalized();
  const ColumnGrid grid(solids, direction, 0.1);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 p(at(random), at(random), at(random));
    const std::vector<int>& near = grid.Near(p);
    for (int i = 0; i < 20; ++i) {
      const Vec3 start = p - 10 * direction;
      Solid wide = solids[i];
      wide.radius += 0.1;
      if (HitSolid(start, direction, wide) == kFar) continue;
      EXPECT_TRUE(std::find(near.begin(), near.end(), i) != near.end());
    }
  }
}

RenderCamera Ahead() { return {Vec3(0, 1.2, 4), Vec3(0, 1, 0), 30 * kDegree}; }

TEST(RenderCapsules, ShowsTheCapsuleInTheMiddleAndTheFloorBelow) {
  const Image image =
      RenderCapsules({{Vec3(0, 0.9, 0), Vec3(0, 1.1, 0), 0.15, kRed}}, Ahead(), 161, 121);
  const unsigned char* middle = image.At(80, 60);
  EXPECT_GT(middle[0], 120);
  EXPECT_GT(middle[0], 2 * middle[1]);
  EXPECT_GT(middle[0], 2 * middle[2]);
  const unsigned char* floor = image.At(5, 115);
  EXPECT_LT(std::abs(floor[0] - floor[2]), 12) << "grey";
  EXPECT_GT(floor[1], 200);
  EXPECT_GT(image.At(5, 2)[1], 235) << "the background is near white";
}

TEST(RenderCapsules, ShowsTheNearerOfTwo) {
  const RenderCapsule near{Vec3(-0.3, 1, 0.5), Vec3(0.3, 1, 0.5), 0.1, kBlue};
  const RenderCapsule far{Vec3(0, 0.5, 0), Vec3(0, 1.5, 0), 0.1, kRed};
  for (const auto& scene : {std::vector{near, far}, std::vector{far, near}}) {
    const Image image = RenderCapsules(scene, Ahead(), 160, 120);
    EXPECT_GT(image.At(80, 62)[2], image.At(80, 62)[0]);
  }
}

TEST(RenderCapsules, DrawsAShadowOnTheFloor) {
  RenderStyle style;
  style.light = Vec3(0, 1, 0);
  style.tile = 100;  // one colour
  const RenderCamera camera{Vec3(0, 3, 4), Vec3(0, 0, 0), 30 * kDegree};
  const Image with =
      RenderCapsules({{Vec3(-0.2, 1, 0), Vec3(0.2, 1, 0), 0.1, kRed}}, camera, 160, 120, style);
  const Image without = RenderCapsules({}, camera, 160, 120, style);
  EXPECT_LT(with.At(80, 60)[1], without.At(80, 60)[1] - 30);
  EXPECT_EQ(with.At(10, 110)[1], without.At(10, 110)[1]);
}

std::vector<RenderCapsule> BentFigure(double side) {
  const Body body = StandardBody(AverageMeasures(1.75));
  Pose pose = RestPose(body);
  pose.root_position = Vec3(side * 0.2, 0.95, 0);
  const auto turn = [&](const char* link, const Vec3& v) {
    pose.rotation[body.FindLink(link)] = ExpSo3(Vec3(v.x(), side * v.y(), side * v.z()));
  };
  turn(side > 0 ? "left_shoulder" : "right_shoulder", Vec3(0.2, -1.1, 0.3));
  turn(side > 0 ? "left_elbow" : "right_elbow", Vec3(0, -1.2, 0));
  turn(side > 0 ? "right_hip" : "left_hip", Vec3(-0.6, 0.2, 0.1));
  turn("waist", Vec3(0.2, 0.4, 0.1));
  return FigureCapsules(body, PoseBody(body, pose), kRed);
}

TEST(RenderCapsules, AMirroredSceneGivesAMirroredPicture) {
  const int width = 320, height = 200;
  RenderStyle style, mirrored = style;
  mirrored.light.x() = -style.light.x();
  const Image image = RenderCapsules(BentFigure(1), Ahead(), width, height, style);
  const Image other = RenderCapsules(BentFigure(-1), Ahead(), width, height, mirrored);
  int different = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        different += std::abs(image.At(x, y)[c] - other.At(width - 1 - x, y)[c]) > 1;
      }
    }
  }
  EXPECT_LE(different, 6) << "a ray that grazes may fall to either side";
}

TEST(RenderCapsules, IsDeterministic) {
  EXPECT_EQ(RenderCapsules(BentFigure(1), Ahead(), 160, 120).rgb,
            RenderCapsules(BentFigure(1), Ahead(), 160, 120).rgb);
}

TEST(FigureCapsules, HasASegmentEachAndANose) { EXPECT_EQ(BentFigure(1).size(), 21U); }

TEST(CameraAround, HasEverythingJustInThePicture) {
  const std::vector<RenderCapsule> capsules = BentFigure(1);
  RenderStyle style;
  style.floor = false;
  for (const double azimuth : {0.0, 1.0, 2.5, 4.0}) {
    for (const double elevation : {-0.2, 0.3, 1.2}) {
      const RenderCamera camera = CameraAround(capsules, azimuth, elevation, 1.5);
      const Image image = RenderCapsules(capsules, camera, 150, 100, style);
      const Image empty = RenderCapsules({}, camera, 150, 100, style);
      int left = 150, right = -1, top = 100, bottom = -1;
      for (int y = 0; y < 100; ++y) {
        for (int x = 0; x < 150; ++x) {
          if (std::equal(image.At(x, y), image.At(x, y) + 3, empty.At(x, y))) continue;
          left = std::min(left, x), right = std::max(right, x);
          top = std::min(top, y), bottom = std::max(bottom, y);
        }
      }
      EXPECT_TRUE(left > 0 && right < 149 && top > 0 && bottom < 99);
      EXPECT_TRUE(bottom - top > 60 || right - left > 90) << "not lost in a corner";
    }
  }
}

TEST(TileImages, PutsPicturesInTheirPlaces) {
  const Image red = BlankImage(4, 3, kRed), blue = BlankImage(2, 5, kBlue);
  const Image sheet = TileImages({{red, blue}, {blue}}, 2);
  EXPECT_EQ(sheet.width, 4 + 2 + 2);
  EXPECT_EQ(sheet.height, 5 + 2 + 5);
  EXPECT_EQ(sheet.At(0, 0)[0], red.rgb[0]);
  EXPECT_EQ(sheet.At(7, 4)[2], blue.rgb[2]);
  EXPECT_EQ(sheet.At(5, 0)[0], 255);
  EXPECT_EQ(sheet.At(0, 7)[2], blue.rgb[2]);
}

TEST(DrawLabel, WritesInsideAndNeverOutside) {
  Image image = BlankImage(40, 20, Vec3::Ones());
  DrawLabel(&image, 2, 3, "I", 2);
  EXPECT_EQ(image.At(2 + 4, 3)[0], image.At(2 + 5, 3 + 13)[0]) << "the stem";
  EXPECT_LT(image.At(2 + 4, 3)[0], 60);
  EXPECT_EQ(image.At(2, 3 + 6)[0], 255);
  const Image before = image;
  DrawLabel(&image, -200, -200, "off", 2);
  EXPECT_EQ(image.rgb, before.rgb);
  DrawLabel(&image, -5, -5, "over every edge \x7f\xff", 3);  // must not write out of bounds
  EXPECT_EQ(LabelWidth("ab", 2), 22);
}

// What the standard's filters 0 to 4 (none, sub, up, average, Paeth) predict from the bytes to the
// left, above, and above left.
int Predicted(int filter, int a, int b, int c) {
  const int p = a + b - c, pa = std::abs(p - a), pb = std::abs(p - b), pc = std::abs(p - c);
  const int paeth = pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
  const int predictions[] = {0, a, b, (a + b) / 2, paeth};
  return predictions[filter];
}

// Undoes EncodePng by the standard's text: chunks, zlib, filters.
Image DecodePng(const std::string& png) {
  const auto number = [&](size_t at) {
    unsigned value = 0;
    for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(png[at + i]);
    return value;
  };
  Image image;
  std::string packed;
  for (size_t at = 8; at < png.size();) {
    const unsigned size = number(at);
    const std::string type = png.substr(at + 4, 4), data = png.substr(at + 8, size);
    const std::string body = type + data;
    EXPECT_EQ(number(at + 8 + size),
              crc32(0, reinterpret_cast<const Bytef*>(body.data()), body.size()));
    if (type == "IHDR") {
      image.width = static_cast<int>(number(at + 8));
      image.height = static_cast<int>(number(at + 12));
    }
    if (type == "IDAT") packed += data;
    at += 12 + size;
  }
  const size_t row = 3 * image.width;
  std::vector<unsigned char> raw((row + 1) * image.height);
  uLongf size = raw.size();
  EXPECT_EQ(
      uncompress(raw.data(), &size, reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
      Z_OK);
  EXPECT_EQ(size, raw.size());
  image.rgb.resize(row * image.height);
  for (int y = 0; y < image.height; ++y) {
    const int filter = raw[y * (row + 1)];
    if (filter > 4) throw std::runtime_error("no such filter");
    for (size_t i = 0; i < row; ++i) {
      const int a = i < 3 ? 0 : image.rgb[y * row + i - 3];
      const int b = y == 0 ? 0 : image.rgb[(y - 1) * row + i];
      const int c = i < 3 || y == 0 ? 0 : image.rgb[(y - 1) * row + i - 3];
      image.rgb[y * row + i] =
          static_cast<unsigned char>(raw[y * (row + 1) + 1 + i] + Predicted(filter, a, b, c));
    }
  }
  return image;
}

TEST(EncodePng, IsReadBack) {
  Image image = BlankImage(37, 23, Vec3::Ones());
  std::mt19937 random(1);
  for (unsigned char& byte : image.rgb) byte = static_cast<unsigned char>(random());
  const std::string png = EncodePng(image);
  EXPECT_EQ(png.substr(0, 8), std::string("\x89PNG\r\n\x1a\n", 8));
  const Image read = DecodePng(png);
  EXPECT_EQ(read.width, 37);
  EXPECT_EQ(read.height, 23);
  EXPECT_EQ(read.rgb, image.rgb);
}

}  // namespace
}  // namespace retarget::io
