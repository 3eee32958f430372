// Contradictions in what the solve was given, which no weight can settle.
#include <algorithm>
#include <cmath>

#include "model/body/path.h"
#include "solver/metrics/diagnosis_cause.h"

namespace retarget::solver {
namespace {

// Two planted feet in one place.
bool FindFeet(const DiagnosisCase& c, Diagnosis* diagnosis) {
  const RequirementCheck& check = diagnosis->check;
  if (TermOf(check.kind) != "penetration") return false;
  const Scene& scene = c.problem.scene();
  std::vector<PlantedFoot> feet;
  for (const LimbNode& limb : check.limbs) {
    const Body& body = scene.body[limb.figure];
    const auto& contacts = scene.contacts[limb.figure];
    const auto planted = std::find_if(contacts.begin(), contacts.end(), [&](const Contact& k) {
      return k.first <= check.frame && check.frame <= k.last &&
             (k.node == limb.node || k.node == body.nodes[limb.node].parent);
    });
    if (planted == contacts.end()) return false;
    feet.push_back({limb.figure, *planted});
  }
  diagnosis->cause = Cause::kFeetInOnePlace;
  diagnosis->feet = feet;
  return true;
}

// Where an end of a hold is tied down: a planted foot, or the world itself.
struct GroundAnchor {
  Vec3 place = Vec3::Zero();
  double reach = 0;  // m, from there to the held point along the stretched body
  std::optional<PlantedFoot> foot = std::nullopt;
};

double LengthAlong(const Body& body, const std::vector<double>& length, int from, int to) {
  double sum = 0;
  const std::vector<int> nodes = NodesOn(body, {std::min(from, to), std::max(from, to)});
  for (size_t k = 1; k < nodes.size(); ++k) {
    const int outer = body.nodes[nodes[k]].parent == nodes[k - 1] ? nodes[k] : nodes[k - 1];
    sum += length[static_cast<size_t>(outer)];
  }
  return sum;
}

std::vector<GroundAnchor> GroundAnchorsOf(const DiagnosisCase& c, const Frame& frame,
                                          const HoldPoint& point) {
  if (point.figure == kWorld) return {{point.offset, 0}};
  const Scene& scene = c.problem.scene();
  std::vector<GroundAnchor> ties;
  for (const Contact& contact : scene.contacts[point.figure]) {
    if (frame.t < contact.first || frame.t > contact.last) continue;
    ties.push_back(
        {frame.posed[point.figure].node[contact.node],
         point.offset.norm() + LengthAlong(scene.body[point.figure], c.subject.length[point.figure],
                                           contact.node, point.node),
         PlantedFoot{point.figure, contact}});
  }
  return ties;
}

// A hold that no pose reaches while the feet stand where they stand.
bool FindOutOfReach(const DiagnosisCase& c, Diagnosis* diagnosis) {
  const RequirementCheck& check = diagnosis->check;
  if (check.kind != RequirementKind::kHold) return false;
  const Hold& hold = c.problem.scene().holds[static_cast<size_t>(check.item)];
  if (hold.from.figure == hold.to.figure) return false;
  Frame frame;
  frame.Set(c.problem.scene(), c.unknowns, check.frame, false);
  for (const GroundAnchor& from : GroundAnchorsOf(c, frame, hold.from)) {
    for (const GroundAnchor& to : GroundAnchorsOf(c, frame, hold.to)) {
      const double apart = (from.place - to.place).norm(), reach = from.reach + to.reach;
      if (apart <= reach) continue;
      diagnosis->cause = Cause::kHoldOutOfReach;
      diagnosis->reach = {{from.foot, to.foot}, apart, reach};
      return true;
    }
  }
  return false;
}

}  // namespace

bool FindContradiction(const DiagnosisCase& c, Diagnosis* diagnosis) {
  return FindFeet(c, diagnosis) || FindOutOfReach(c, diagnosis);
}

PlantedFoot FootOfAnchor(const Scene& scene, int anchor) {
  const int of_a = static_cast<int>(scene.contacts[0].size());
  if (anchor < of_a) return {0, scene.contacts[0][static_cast<size_t>(anchor)]};
  return {1, scene.contacts[1][static_cast<size_t>(anchor - of_a)]};
}

}  // namespace retarget::solver
