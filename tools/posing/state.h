// What an editing session holds and its history keeps: the posture, pins and options.
#pragma once

#include <optional>
#include <vector>

#include "model/body/template_posture.h"
#include "tools/posing/operations.h"

namespace retarget::posing {

struct PinnedNode {
  int figure = 0, node = 0;
  Vec3 position = Vec3::Zero();  // m; where it stays
  std::optional<PinRay> ray;     // or the line that it stays on
};

struct PoseState {
  TemplatePosture posture;
  std::vector<PinnedNode> pins;
  PoseOptions options;
  int document = 0;  // which posture that was opened this is, after all edits
};

inline std::array<PosedBody, 2> PosedFigures(const TemplatePosture& posture) {
  return {PoseBody(posture.body[0], posture.pose[0]), PoseBody(posture.body[1], posture.pose[1])};
}

}  // namespace retarget::posing
