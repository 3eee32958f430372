#include "solver/fit_template.h"

#include <algorithm>

#include "model/path.h"
#include "solver/problem.h"
#include "solver/spacetime.h"

namespace retarget {
namespace {

double GliOf(const TemplatePosture& posture, const std::array<PosedBody, 2>& posed,
             const Path& path_a, const Path& path_b) {
  std::array<std::vector<Vec3>, 2> points;
  for (int f = 0; f < 2; ++f) {
    for (const int n : NodesOn(posture.body[f], f == 0 ? path_a : path_b)) {
      points[f].push_back(posed[f].node[n]);
    }
  }
  return PolylineGli(points[0], points[1]);
}

std::array<PosedBody, 2> PosedFigures(const TemplatePosture& posture) {
  return {PoseBody(posture.body[0], posture.pose[0]), PoseBody(posture.body[1], posture.pose[1])};
}

}  // namespace

TemplateTangles FindTemplateTangles(const TemplatePosture& posture,
                                    const TangleSettings& settings) {
  const std::array<PosedBody, 2> posed = PosedFigures(posture);
  const Body& a = posture.body[0];
  const Body& b = posture.body[1];
  const MatX table = SegmentGliTable(a, posed[0].node, b, posed[1].node);
  TemplateTangles out;
  out.literal = FindTangles(a, b, table);
  if (!posture.tangles.empty()) {
    for (const TangleRequest& request : posture.tangles) {
      Tangle tangle{request.a, request.b, GliOf(posture, posed, request.a, request.b)};
      const double norm = TangleGradientNorm(a, posed[0], b, posed[1], tangle);
      out.tags.push_back({tangle, (std::abs(tangle.gli) - kTangleThreshold) / norm, 1});
    }
    return out;
  }
  ReductionOptions options;
  options.min_rho = settings.min_rho;
  options.max_tags = settings.max_tags;
  out.tags = ReduceTangles(a, posed[0], b, posed[1], out.literal, table, options);
  return out;
}

std::vector<HeldTangle> HoldTangles(const std::vector<Tag>& tags, const TemplatePosture& posture,
                                    double margin) {
  const std::array<PosedBody, 2> posed = PosedFigures(posture);
  std::vector<HeldTangle> held;
  for (const Tag& tag : tags) {
    const double sign = tag.tangle.gli < 0 ? -1 : 1;
    const double here = sign * GliOf(posture, posed, tag.tangle.a, tag.tangle.b);
    held.push_back({tag, sign, std::min(kTangleThreshold + margin, std::max(here, 0.0))});
  }
  return held;
}

TemplatePosture FitTemplate(const TemplatePosture& posture, const std::array<Body, 2>& body,
                            const std::vector<Tag>& tags, const Settings& settings) {
  TemplatePosture fitted = OnBodies(posture, body);
  Scene scene;
  scene.body = body;
  scene.posture = fitted;
  for (int f = 0; f < 2; ++f) scene.source[f].frames = {fitted.pose[f]};
  // The value that counts is the template's own: on its bodies, not on these.
  scene.tangles = HoldTangles(tags, posture, settings.tangle.margin);
  scene.holds = fitted.holds;
  Settings one_frame = settings;
  one_frame.solve.max_iterations = 200;
  one_frame.solve.max_seconds = 0;
  one_frame.solve.polish_decrease = 1e-6;
  one_frame.solve.backend = "banded";
  const Problem problem(scene, one_frame);
  const SolveResult solved =
      SolveSpacetime(problem, UnknownsFromPoses(scene, scene.source), nullptr);
  const std::array<Clip, 2> poses = EditedClips(scene, solved.unknowns);
  for (int f = 0; f < 2; ++f) fitted.pose[f] = poses[f].frames[0];
  return fitted;
}

}  // namespace retarget
