// The template posture: two figures posed once, and what must stay as it is there
// (Ho and Komura 2007, section 3).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/body/body.h"
#include "model/body/hand_contact.h"
#include "model/body/path.h"
#include "model/body/pose.h"
#include "model/body/tangle.h"

namespace retarget {

// Figures are numbered: 0 is a, 1 is b; a hold may also be made to the world.
inline constexpr int kWorld = 2;

// A point of a figure (node, and an offset in the frame of the link that carries it) or of the
// world (offset = the position itself), m.
struct HoldPoint {
  int figure = 0;
  int node = 0;
  Vec3 offset = Vec3::Zero();
};

// Two points that stay together. Without an offset of its own, `to` is where `from` is in the
// template posture, so a hold never asks for overlap.
struct Hold {
  HoldPoint from, to;
  bool rotation = false;                      // also keep the relative orientation (Eq. 5)
  Quat relative_rotation = Quat::Identity();  // of from's link in to's frame, in the template
};

// Whose motion a figure's root follows.
enum class RootReference { kOwnClip, kPartner };

// A tangle that the user listed herself.
struct TangleRequest {
  Path a, b;
};

// A photograph that the posture was made over, and the view of it.
struct TemplatePhoto {
  std::string file;
  double opacity = 0.5, scale = 1;
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
};
struct TemplateCamera {
  Vec3 eye = Vec3(0, 1.3, 4), target = Vec3(0, 1, 0);
  double fov_deg = 40;
};

struct TemplatePosture {
  std::string name;
  std::string description;
  std::vector<std::string> keywords;
  std::array<Body, 2> body;
  std::array<Pose, 2> pose;
  std::vector<Hold> holds;
  std::optional<std::vector<HandContact>> contacts;  // nothing: those found in the posture
  std::array<std::vector<int>, 2> supports;          // nodes that may be planted
  std::array<RootReference, 2> root = {RootReference::kOwnClip, RootReference::kOwnClip};
  std::vector<TangleRequest> tangles;  // empty: find and reduce
  std::optional<TemplatePhoto> photo;
  std::optional<TemplateCamera> camera;
};

// World position of a hold's end.
Vec3 HoldPosition(const HoldPoint& point, const std::array<Body, 2>& body,
                  const std::array<PosedBody, 2>& posed);

// The posture's own list of contacts, or those found in it.
std::vector<HandContact> HandContactsOf(const TemplatePosture& posture, double reach);

// Ankles and toes that stand lower than 15 cm: the default of `supports`.
std::vector<int> StandingNodes(const Body& body, const PosedBody& posed);

// The same posture on other bodies: joint rotations stay, root heights and offsets follow the
// stature, distances between the figures the mean of both.
TemplatePosture OnBodies(const TemplatePosture& posture, const std::array<Body, 2>& body);

}  // namespace retarget
