#include "solver/start/fit_template.h"

#include <algorithm>
#include <cmath>

#include "model/body/path.h"
#include "solver/optimizer/spacetime.h"
#include "solver/problem/problem.h"

namespace retarget::solver {
namespace {

// Change of a segment's length per step of the fit, as a share: a few millimetres of a limb, less
// than its capsule's radius, so that no limb leaps over the one it lies against.
constexpr double kLargestChange = 0.02;
constexpr int kMostSteps = 40;  // bodies that differ by more than 80 % take longer steps
// One frame, from a near start: iterations are cheap, and a rough fit would add up over the steps.
constexpr int kIterations = 200;
constexpr double kRelativeDecrease = 1e-5;

double GliOf(const TemplatePosture& posture, const std::array<PosedBody, 2>& posed,
             const Path& path_a, const Path& path_b) {
  return GliOfPaths(posture.body[0], posed[0].node, path_a, posture.body[1], posed[1].node, path_b);
}

std::array<PosedBody, 2> PosedFigures(const TemplatePosture& posture) {
  return {PoseBody(posture.body[0], posture.pose[0]), PoseBody(posture.body[1], posture.pose[1])};
}

// The body a share u of the way from one to another of the same tree.
Body Between(const Body& from, const Body& to, double u) {
  Body out = to;
  out.stature = (1 - u) * from.stature + u * to.stature;
  for (size_t l = 0; l < out.links.size(); ++l) {
    out.links[l].centre = (1 - u) * from.links[l].centre + u * to.links[l].centre;
  }
  for (size_t n = 0; n < out.nodes.size(); ++n) {
    out.nodes[n].offset = (1 - u) * from.nodes[n].offset + u * to.nodes[n].offset;
    out.nodes[n].radius = (1 - u) * from.nodes[n].radius + u * to.nodes[n].radius;
  }
  return out;
}

// Steps from body to body: no segment changes by more than kLargestChange of its length in one.
int StepsBetween(const Body& from, const Body& to) {
  double change = 0;
  for (int n = 1; n < to.num_nodes(); ++n) {
    change = std::max(change, std::abs(to.SegmentLength(n) / from.SegmentLength(n) - 1));
  }
  return std::clamp(static_cast<int>(std::ceil(change / kLargestChange)), 1, kMostSteps);
}

}  // namespace

ReductionOptions ReductionOf(const TangleSettings& settings) {
  ReductionOptions options;
  options.min_rho = settings.min_rho;
  options.min_rho_share = settings.min_rho_share;
  options.max_tags = settings.max_tags;
  return options;
}

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
  out.tags = ReduceTangles(a, posed[0], b, posed[1], out.literal, table, ReductionOf(settings));
  return out;
}

std::vector<TangleTarget> TangleTargets(const std::vector<Tag>& tags,
                                        const TemplatePosture& posture, double margin) {
  const std::array<PosedBody, 2> posed = PosedFigures(posture);
  std::vector<TangleTarget> held;
  for (const Tag& tag : tags) {
    const double sign = tag.tangle.gli < 0 ? -1 : 1;
    const double here = sign * GliOf(posture, posed, tag.tangle.a, tag.tangle.b);
    held.push_back({tag, sign, std::min(kTangleThreshold + margin, std::max(here, 0.0)), here});
  }
  return held;
}

TemplatePosture FitTemplate(const TemplatePosture& posture, const std::array<Body, 2>& body,
                            const std::vector<Tag>& tags, const Settings& settings) {
  Settings one_frame = settings;
  one_frame.solve.max_iterations = kIterations;
  one_frame.solve.max_seconds = 0;
  one_frame.solve.polish_decrease = kRelativeDecrease;
  one_frame.solve.backend = Backend::kBanded;
  one_frame.solve.threads = 1;
  one_frame.solve.stages = {1};
  const int steps =
      std::max(StepsBetween(posture.body[0], body[0]), StepsBetween(posture.body[1], body[1]));
  Scene scene;
  // The value that counts is the template's own: on its bodies, not on these.
  scene.tangles = TangleTargets(tags, posture, settings.tangle.margin);
  scene.hand_contacts = HandContactsOf(posture, settings.hand_contact.reach_m);
  TemplatePosture fitted = posture;
  TemplatePosture last = posture;
  for (int k = 1; k <= steps; ++k) {
    const double u = static_cast<double>(k) / steps;
    const TemplatePosture wanted = OnBodies(
        posture, {Between(posture.body[0], body[0], u), Between(posture.body[1], body[1], u)});
    scene.body = wanted.body;
    scene.posture = wanted;
    scene.holds = wanted.holds;
    std::array<Clip, 2> start;
    for (int f = 0; f < 2; ++f) {
      scene.source[f].frames = {wanted.pose[f]};
      start[f].frames = {fitted.pose[f]};
      start[f].frames[0].root_position += wanted.pose[f].root_position - last.pose[f].root_position;
    }
    const Problem problem(scene, one_frame);
    const SolveResult solved = SolveSpacetime(problem, UnknownsFromPoses(scene, start), nullptr);
    const std::array<Clip, 2> poses = EditedClips(scene, solved.unknowns);
    fitted = wanted;
    for (int f = 0; f < 2; ++f) fitted.pose[f] = poses[f].frames[0];
    last = wanted;
  }
  fitted.body = body;
  return fitted;
}

}  // namespace retarget::solver
