// The template posture on two given bodies, and the tangles that are to be kept.
#pragma once

#include <vector>

#include "model/body/template_posture.h"
#include "model/settings.h"
#include "solver/problem/scene.h"

namespace retarget::solver {

// The literal tangles of a template and its tags: the user's own list, else the reduction.
struct TemplateTangles {
  std::vector<Tangle> literal;
  std::vector<Tag> tags;
};
// How tags are chosen among what is found.
ReductionOptions ReductionOf(const TangleSettings& settings);

TemplateTangles FindTemplateTangles(const TemplatePosture& posture, const TangleSettings& settings);

// Fits a template to other bodies: joint rotations are tracked while one-frame solves with the
// terms of the spacetime problem restore holds, tangles and non-penetration. The bodies are changed
// little by little, each solve starting where the last one ended, so that an arm that goes under an
// arm in the template still does so on a body that is a head shorter.
TemplatePosture FitTemplate(const TemplatePosture& posture, const std::array<Body, 2>& body,
                            const std::vector<Tag>& tags, const Settings& settings);

// What is asked of the tags: half a turn and the margin, never above the posture's own value, and
// best that value.
std::vector<TangleTarget> TangleTargets(const std::vector<Tag>& tags,
                                        const TemplatePosture& posture, double margin);

}  // namespace retarget::solver
