// Two figures of any program, to be proved against a template.
#pragma once

#include <string>
#include <vector>

#include "io/clip_options.h"
#include "model/body/template_posture.h"
#include "tools/proof/scene_proof.h"

namespace retarget::proof {

struct ForeignScene {
  KeyedMotion motion;
  std::array<std::vector<int>, 2> node;
  solver::MetricsContext subject;  // without contacts: whose feet were planted, no file says
  std::vector<std::string> notes;  // what is not judged or was taken for granted, a line each

  solver::Proof Prove(const Requirements& limits) const {
    return solver::Prove({motion, node, subject, limits});
  }
};

// A GLB whose figures are nodes "a/<node>" and "b/<node>", by the rules of io/scene/scene_glb.h.
bool HasNamedFigures(const std::string& path);
ForeignScene ReadNamedFigures(const std::string& path, const TemplatePosture& posture,
                              const TangleSettings& tangle);

// Two clips of any format, or two figures of one file (path#skin=..., or one joint map each). The
// bodies are measured in the clips, radii come from their skins or from tables. Between the frames
// of either, joints move as between keys of a glTF; figures of different rates get the keys of
// both.
ForeignScene ReadFigures(const std::array<io::ClipOptions, 2>& figures,
                         const TemplatePosture& posture, const TangleSettings& tangle);

}  // namespace retarget::proof
