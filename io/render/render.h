// Still pictures of figures without a GPU or a browser: a ray caster of capsules on a floor.
//
// Every visible point is lit by a key light with soft shadows and by a sky above a bright floor,
// dimmed where other capsules stand near. Shadows and dimming have closed forms, so there is no
// noise, and the same input gives the same picture.
#pragma once

#include <vector>

#include "io/render/image.h"
#include "model/body/body.h"
#include "model/body/pose.h"
#include "model/geometry/types.h"

namespace retarget::io {

struct RenderCapsule {
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();  // ends of the axis (m, world)
  double radius = 0;                        // m
  Vec3 colour = Vec3::Ones();               // sRGB, components in [0, 1]
};

struct RenderCamera {
  Vec3 eye = Vec3(0, 1.5, 4), target = Vec3(0, 1, 0);  // m, world
  double fov_y_rad = 30 * kDegree;                     // from bottom to top
};

struct RenderStyle {
  // Direction to the key light in the camera's turn about the vertical: x right, y up, z towards
  // the eye. Need not have unit length.
  Vec3 light = Vec3(-0.55, 1.0, 0.6);
  bool floor = true;  // checkered, at y = 0
  double tile = 0.5;  // side of its squares (m); one is centred on the origin
};

// Edges are smoothed with 4 x 4 samples per pixel.
Image RenderCapsules(const std::vector<RenderCapsule>& capsules, const RenderCamera& camera,
                     int width, int height, const RenderStyle& style = {});

// The capsules of a posed body, nose included.
std::vector<RenderCapsule> FigureCapsules(const Body& body, const PosedBody& posed,
                                          const Vec3& colour);

// A camera that looks from `azimuth` (rad about the vertical, 0 from +Z, positive towards +X) and
// `elevation` (rad over the horizon) and has all capsules just in the picture. `aspect` is its
// width over its height.
RenderCamera CameraAround(const std::vector<RenderCapsule>& capsules, double azimuth,
                          double elevation, double aspect, double fov_y_rad = 30 * kDegree);

}  // namespace retarget::io
