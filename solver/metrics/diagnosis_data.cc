// Contradictions in what the solve was given, which no weight can settle.
#include <algorithm>
#include <cmath>

#include "model/body/path.h"
#include "solver/metrics/diagnosis_text.h"

namespace retarget::solver {
namespace {

// Two planted feet in one place.
std::string TwoFeet(const ConflictCase& c) {
  if (c.check.term != "penetration") return "";
  const Scene& scene = c.problem.scene();
  std::string names;
  for (const LimbNode& limb : c.check.limbs) {
    const Body& body = scene.body[limb.figure];
    const auto& contacts = scene.contacts[limb.figure];
    const auto planted = std::find_if(contacts.begin(), contacts.end(), [&](const Contact& k) {
      return k.first <= c.check.frame && c.check.frame <= k.last &&
             (k.node == limb.node || k.node == body.nodes[limb.node].parent);
    });
    if (planted == contacts.end()) return "";
    names += (names.empty() ? "" : "; ") + PlantedName(scene, {limb.figure, *planted});
  }
  return "the clips plant both feet in one place (" + names +
         "): begin one clip at another instant (--start-a, --start-b), or take one foot out of the "
         "template's supports";
}

// Where an end of a hold is tied down: a planted foot, or the world itself.
struct Tie {
  Vec3 place = Vec3::Zero();
  double reach = 0;  // m, from there to the held point along the stretched body
  std::string name;
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

std::vector<Tie> TiesOf(const ConflictCase& c, const Frame& frame, const HoldPoint& point) {
  if (point.figure == kWorld) return {{point.offset, 0, "its place in the world"}};
  const Scene& scene = c.problem.scene();
  std::vector<Tie> ties;
  for (const Contact& contact : scene.contacts[point.figure]) {
    if (frame.t < contact.first || frame.t > contact.last) continue;
    ties.push_back(
        {frame.posed[point.figure].node[contact.node],
         point.offset.norm() + LengthAlong(scene.body[point.figure], c.subject.length[point.figure],
                                           contact.node, point.node),
         PlantedName(scene, {point.figure, contact})});
  }
  return ties;
}

// A hold that no pose reaches while the feet stand where they stand.
std::string OutOfReach(const ConflictCase& c) {
  if (c.check.term != "hold") return "";
  const Hold& hold = c.problem.scene().holds[static_cast<size_t>(c.check.item)];
  if (hold.from.figure == hold.to.figure) return "";
  const bool world = hold.from.figure == kWorld || hold.to.figure == kWorld;
  Frame frame;
  frame.Set(c.problem.scene(), c.unknowns, c.check.frame, false);
  for (const Tie& from : TiesOf(c, frame, hold.from)) {
    for (const Tie& to : TiesOf(c, frame, hold.to)) {
      const double apart = (from.place - to.place).norm(), reach = from.reach + to.reach;
      if (apart <= reach) continue;
      return Text(
          "a contact and the hold contradict each other: %s is %.2f m from %s, the %s "
          "%.2f m at full stretch; no weight mends that while the feet stay, so move a "
          "clip, or change the hold or the supports in the template",
          from.name.c_str(), apart, to.name.c_str(),
          world ? "body between them" : "two bodies between them", reach);
    }
  }
  return "";
}

}  // namespace

std::string ContradictionInData(const ConflictCase& c) {
  const std::string feet = TwoFeet(c);
  return feet.empty() ? OutOfReach(c) : feet;
}

AnchoredContact ContactOfAnchor(const Scene& scene, int anchor) {
  const int of_a = static_cast<int>(scene.contacts[0].size());
  if (anchor < of_a) return {0, scene.contacts[0][static_cast<size_t>(anchor)]};
  return {1, scene.contacts[1][static_cast<size_t>(anchor - of_a)]};
}

}  // namespace retarget::solver
