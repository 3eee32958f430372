#include "solver/start/quasi_static.h"

#include <algorithm>

#include "model/body/pass_through.h"
#include "solver/optimizer/frame_solve.h"
#include "solver/problem/parallel.h"
#include "solver/problem/time_guard.h"

namespace retarget::solver {
namespace {

// Iterations of a frame. Few, as its neighbour is solved already and the spacetime solve follows;
// the first frame comes from the template posture, with all the way to go.
constexpr int kIterations = 8;
constexpr int kIterationsOfFirst = 80;
// Of solve.step_limit_m: a frame by itself has no neighbours in time that damp its steps.
constexpr double kStepShare = 0.5;
// 1/rad, 1/m: the edit stays near that of the frame before, or the pass would not be smooth.
constexpr double kFollowWeight = 3;

FrameSolveOptions OptionsOf(const SolveSettings& settings) {
  FrameSolveOptions options;
  options.max_iterations = kIterations;
  options.step_limit_m = kStepShare * settings.step_limit_m;
  options.gli_jump = settings.gli_jump;
  options.guard_reach = kStartGuardReach;
  return options;
}

// One direction of the pass, from the template's frame outwards.
class Pass {
 public:
  Pass(const Problem& problem, const Unknowns& start)
      : problem_(problem),
        scene_(problem.scene()),
        options_(OptionsOf(problem.settings().solve)),
        x_(start) {}

  // Solves the template's frame from the edit it has.
  void SolveFirst(int t) {
    FrameSolveOptions options = options_;
    options.max_iterations = kIterationsOfFirst;
    last_ =
        SolveFrame(problem_, {.t = t, .free_anchors = StartedAnchors(t, -1)}, options, &x_).node;
  }

  // Goes on from frame t as it is; contacts stay where they are.
  void ContinueFrom(int t) {
    last_ = NodesAt(t);
    anchors_free_ = false;
  }

  // Solves frame t from the edit of `previous`, the frame it follows.
  void SolveNext(int t, int previous) {
    x_.edit.col(t) = x_.edit.col(previous);
    // Where the capture itself goes through a limb, start from the pose of the frame before.
    const NodePositions now = NodesAt(t);
    if (LargestGliJump(scene_.body, last_, now, options_.guard_reach).size > options_.gli_jump ||
        (MayMeetOnTheWay(scene_.body, last_, now) &&
         !WayBetween(scene_, x_.edit, previous, t).IsClear())) {
      KeepPose(previous, t);
    }
    const FrameTask task = {.t = t,
                            .follow_weight = kFollowWeight,
                            .follow = x_.edit.col(t),
                            .also_from = &last_,
                            .also_from_frame = previous,
                            .free_anchors = StartedAnchors(t, previous)};
    last_ = SolveFrame(problem_, task, options_, &x_).node;
  }

  const Unknowns& unknowns() const { return x_; }

 private:
  NodePositions NodesAt(int t) const {
    Frame frame;
    frame.Set(scene_, x_, t, false);
    return {frame.posed[0].node, frame.posed[1].node};
  }

  // Gives frame t the edit that keeps the pose of `previous`.
  void KeepPose(int previous, int t) {
    Pose pose;
    for (int f = 0; f < 2; ++f) {
      EditedPose(scene_, f, previous, x_.edit, &pose);
      EditOf(scene_, f, t, pose, previous, &x_.edit);
    }
  }

  // Contacts that begin with frame t, in the pass's direction: their anchors are still free.
  std::vector<FreeAnchor> StartedAnchors(int t, int previous) const {
    std::vector<FreeAnchor> started;
    if (!anchors_free_) return started;
    int anchor = 0;
    for (int f = 0; f < 2; ++f) {
      for (const Contact& c : scene_.contacts[f]) {
        const bool here = c.first <= t && t <= c.last;
        const bool before = previous >= c.first && previous <= c.last;
        if (here && !before) started.push_back({anchor, f, c.node});
        ++anchor;
      }
    }
    return started;
  }

  const Problem& problem_;
  const Scene& scene_;
  FrameSolveOptions options_;
  Unknowns x_;
  NodePositions last_;  // of the frame before
  bool anchors_free_ = true;
};

// Anchors go where their feet stand on average.
void CentreAnchors(const Scene& scene, Unknowns* x) {
  x->anchor = UnknownsFromPoses(scene, EditedClips(scene, *x)).anchor;
}

}  // namespace

Unknowns QuasiStaticPass(const Problem& problem, const Unknowns& start) {
  const Scene& scene = problem.scene();
  const int middle = scene.template_frame;
  Pass forward(problem, start);
  forward.SolveFirst(middle);
  Pass backward = forward;
  Pass* passes[2] = {&forward, &backward};
  ParallelFor(2, 2, [&](int k, int) {
    const int direction = k == 0 ? 1 : -1;
    for (int t = middle + direction; t >= 0 && t < scene.num_frames(); t += direction) {
      passes[k]->SolveNext(t, t - direction);
    }
  });
  Unknowns out = forward.unknowns();
  out.edit.leftCols(middle) = backward.unknowns().edit.leftCols(middle);
  CentreAnchors(scene, &out);
  return out;
}

int CurePassThroughs(const Problem& problem, Unknowns* x) {
  const Scene& scene = problem.scene();
  const int n = scene.num_frames();
  Pass pass(problem, *x);
  int solved = 0;
  for (const int direction : {1, -1}) {
    const auto inside = [&](int t) { return t >= 0 && t < n; };
    const auto goes_through = [&](int t) {
      return !WayBetween(scene, pass.unknowns().edit, t, t + direction).IsClear();
    };
    for (int t = scene.template_frame; inside(t + direction); t += direction) {
      if (!goes_through(t)) continue;
      pass.ContinueFrom(t);
      do {
        t += direction;
        pass.SolveNext(t, t - direction);
        ++solved;
      } while (inside(t + direction) && goes_through(t));
    }
  }
  *x = pass.unknowns();
  return solved;
}

}  // namespace retarget::solver
