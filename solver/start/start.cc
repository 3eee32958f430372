#include "solver/start/start.h"

#include "model/body/path.h"
#include "model/geometry/so3.h"
#include "solver/start/quasi_static.h"

namespace retarget::solver {
namespace {

// Marks the links that carry a node, and all they hang on.
void MarkChain(const Body& body, int node, std::vector<char>* marked) {
  for (int l = body.nodes[node].link; l >= 0; l = body.links[l].parent) (*marked)[l] = 1;
}

// Links whose rotations decide tags and holds.
std::vector<char> InvolvedLinks(const Scene& scene, int figure) {
  const Body& body = scene.body[figure];
  std::vector<char> marked(body.links.size(), 0);
  for (const TangleTarget& held : scene.tangles) {
    const Path& path = figure == 0 ? held.tag.tangle.a : held.tag.tangle.b;
    for (const int n : NodesOn(body, path)) MarkChain(body, n, &marked);
  }
  for (const Hold& hold : scene.holds) {
    for (const HoldPoint& point : {hold.from, hold.to}) {
      if (point.figure == figure) MarkChain(body, point.node, &marked);
    }
  }
  return marked;
}

// The rigid motion that carries the template along with a figure's placed clip: it brings the
// figure's root from where it is at the template's instant to where it is at frame t.
struct RigidMotion {
  Quat rotation;
  Vec3 translation;
};

RigidMotion CarriedBy(const Scene& scene, int figure, int t) {
  // Roots with clips of their own have been brought together: they differ by little.
  const auto root = [&](int frame) {
    const RootShift shift =
        scene.root[figure] == RootReference::kOwnClip ? scene.BaseOf(figure, frame) : RootShift{};
    return ShiftedRoot(scene.source[figure].frames[frame], shift);
  };
  const Pose from = root(scene.template_frame), to = root(t);
  // Heading only: a leaning carrier does not tip its partner over.
  const Quat turn = YawRotation(YawOf(to.rotation[0] * from.rotation[0].conjugate()));
  return {turn, to.root_position - turn * from.root_position};
}

RigidMotion MotionOfPair(const Scene& scene, int t) {
  if (scene.root[0] == RootReference::kPartner) return CarriedBy(scene, 1, t);
  if (scene.root[1] == RootReference::kPartner) return CarriedBy(scene, 0, t);
  const RigidMotion a = CarriedBy(scene, 0, t), b = CarriedBy(scene, 1, t);
  const Quat turn = a.rotation.slerp(0.5, b.rotation);
  // Half way between where the two motions take the middle of the figures.
  const Vec3 middle =
      0.5 * (scene.posture.pose[0].root_position + scene.posture.pose[1].root_position);
  const Vec3 target =
      0.5 * (a.rotation * middle + a.translation + b.rotation * middle + b.translation);
  return {turn, target - turn * middle};
}

}  // namespace

std::array<Clip, 2> TemplateRelativePoses(const Scene& scene) {
  std::array<Clip, 2> start = scene.source;
  const std::array<std::vector<char>, 2> involved = {InvolvedLinks(scene, 0),
                                                     InvolvedLinks(scene, 1)};
  for (int t = 0; t < scene.num_frames(); ++t) {
    const RigidMotion motion = MotionOfPair(scene, t);
    for (int f = 0; f < 2; ++f) {
      Pose& pose = start[f].frames[t];
      const Pose moved = Moved(scene.posture.pose[f], motion.rotation, motion.translation);
      pose.root_position = moved.root_position;
      for (int l = 0; l < scene.body[f].num_links(); ++l) {
        const bool locked = scene.body[f].links[l].locked;
        if (involved[f][l] && !locked) pose.rotation[l] = moved.rotation[l];
      }
    }
  }
  return start;
}

Unknowns TemplateStart(const Problem& problem) {
  const Scene& scene = problem.scene();
  // Frame by frame the footprint that a free foot will come to is not known yet.
  Settings settings = problem.settings();
  settings.weights.foot_swing = 0;
  return QuasiStaticPass(Problem(scene, settings),
                         UnknownsFromPoses(scene, TemplateRelativePoses(scene)));
}

}  // namespace retarget::solver
