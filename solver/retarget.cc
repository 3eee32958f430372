#include "solver/retarget.h"

#include <cstdio>
#include <utility>

#include "model/body/joint_limit.h"
#include "model/body/travel.h"
#include "solver/attempts.h"
#include "solver/problem/root_targets.h"
#include "solver/start/clip_fit.h"
#include "solver/start/weak_tags.h"

namespace retarget::solver {
namespace {

std::string WithNumber(const std::string& text, double value) {
  char number[32];
  std::snprintf(number, sizeof number, "%.2f", value);
  return text + number;
}

void WarnOfWeakTags(RetargetResult* result) {
  for (const TangleTarget& held : result->scene.tangles) {
    const std::string who =
        TangleText(result->scene.body[0], result->scene.body[1], held.tag.tangle);
    if (IsWeak(held.tag)) {
      result->warnings.push_back(WithNumber("tag " + who + " is weak in the template: |GLI| ",
                                            std::abs(held.tag.tangle.gli)));
    } else if (IsEasilyLost(held.tag)) {
      result->warnings.push_back(
          WithNumber("tag " + who + " is easily lost: robustness radius ", held.tag.rho));
    }
  }
  if (result->scene.tangles.empty()) {
    result->warnings.push_back(
        "the template has no tangles: only holds and contacts tie the figures");
  }
}

// Joints that the template itself bends further than people can: the solve follows it there.
void WarnOfLimits(const TemplatePosture& posture, RetargetResult* result) {
  constexpr double kWorthAWord = 1 * kDegree;
  for (int f = 0; f < 2; ++f) {
    for (int l = 1; l < posture.body[f].num_links(); ++l) {
      const double beyond = FurthestBeyondLimit(posture.body[f], l, posture.pose[f]);
      if (beyond < kWorthAWord) continue;
      char sentence[160];
      std::snprintf(sentence, sizeof sentence,
                    "the template bends %c's %s %.0f degrees beyond its range of motion",
                    f == 0 ? 'a' : 'b', posture.body[f].links[l].name.c_str(), beyond / kDegree);
      result->warnings.emplace_back(sentence);
    }
  }
}

// A figure that stands in the template, and in whose clip no foot is ever planted.
void WarnOfFeet(int f, const Settings& settings, RetargetResult* result) {
  const Scene& scene = result->scene;
  if (scene.posture.supports[f].empty() || !scene.contacts[f].empty()) return;
  const Travel travel = FindTravel(scene.body[f], scene.source[f], settings.contact);
  char sentence[160];
  std::snprintf(
      sentence, sizeof sentence,
      "no planted foot found in clip %c: nothing holds its feet, and nothing can be said of "
      "them; the lowest moves at %.2f m/s (median)",
      f == 0 ? 'a' : 'b', travel.sliding_speed);
  result->warnings.emplace_back(sentence);
}

}  // namespace

RetargetResult Prepare(const RetargetInput& input, const Settings& settings) {
  RetargetResult result;
  result.tangles = FindTemplateTangles(input.posture, settings.tangle);
  Scene& scene = result.scene;
  scene.body = input.body;
  scene.template_frame = input.template_frame;
  TemplatePosture posture = input.posture;
  posture.contacts = HandContactsOf(posture, settings.hand_contact.reach_m);
  scene.posture = FitTemplate(posture, input.body, result.tangles.tags, settings);
  scene.tangles = TangleTargets(result.tangles.tags, scene.posture, settings.tangle.margin);
  scene.holds = scene.posture.holds;
  scene.hand_contacts = *scene.posture.contacts;
  scene.root = scene.posture.root;
  scene.locked_axes = input.locked_axes;
  for (int f = 0; f < 2; ++f) {
    scene.contacts[f] =
        DetectContacts(input.body[f], input.clip[f], scene.posture.supports[f], settings.contact);
    result.placement[f] = PlaceAt(input.body[f], input.clip[f], input.template_frame,
                                  scene.posture.pose[f], scene.contacts[f]);
    scene.source[f] = Placed(input.clip[f], result.placement[f]);
  }
  scene.base = EditBase(scene);
  WarnOfWeakTags(&result);
  WarnOfLimits(input.posture, &result);
  for (int f = 0; f < 2; ++f) WarnOfFeet(f, settings, &result);
  const ClipFit fit = FitOf(input.posture, result.tangles.tags, input.clip, input.template_frame);
  for (std::string& warning : WarningsOf(fit, IsSameMotion(input.clip[0], input.clip[1]))) {
    result.warnings.push_back(std::move(warning));
  }
  return result;
}

RetargetResult Retarget(const RetargetInput& input, const Settings& settings,
                        const Progress& progress) {
  RetargetResult result = Prepare(input, settings);
  const Problem problem(result.scene, settings);
  result.simulation = Simulate(result.scene, settings.simulation);
  SolveInAttempts(problem, progress, &result);
  if (result.solve.stalled) {
    result.warnings.push_back(
        "the solve stalled: no further step was acceptable; the best so far is kept");
  }
  result.solved = EditedClips(result.scene, result.solve.unknowns);
  result.costs = problem.CostByTerm(result.solve.unknowns);
  return result;
}

}  // namespace retarget::solver
