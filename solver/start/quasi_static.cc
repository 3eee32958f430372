#include "solver/start/quasi_static.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "model/body/pass_through.h"
#include "solver/optimizer/kernels.h"
#include "solver/optimizer/normal_equations.h"
#include "solver/problem/parallel.h"

namespace retarget::solver {
namespace {

// One direction of the pass, from the template's frame outwards.
class Pass {
 public:
  Pass(const Problem& problem, const Unknowns& start, const QuasiStaticOptions& options)
      : problem_(problem), scene_(problem.scene()), options_(options), x_(start) {}

  // Solves `frame` from the edit it has; `previous` (if there is one) is the frame it follows.
  void SolveFrame(int t, int previous) {
    const int n = scene_.num_coordinates();
    VecX follow = VecX::Zero(n);
    if (previous >= 0) {
      x_.edit.col(t) = x_.edit.col(previous);
      // Where the capture itself goes through a limb, start from the pose of the frame before.
      if (LargestGliJump(scene_.body, last_, NodesAt(t), options_.guard_reach).size >
          options_.gli_jump) {
        KeepPose(previous, t);
      }
      follow = x_.edit.col(t);
    }
    StartAnchors(t, previous);
    NodePositions accepted = NodesAt(t);
    double cost = Cost(t, follow, previous >= 0);
    double damping = 1e-3;
    const int most = previous < 0 ? 10 * options_.most_iterations : options_.most_iterations;
    for (int iteration = 0; iteration < most; ++iteration) {
      Linearise(t, follow, previous >= 0);
      bool moved = false;
      double decrease = 0;
      for (int attempt = 0; attempt < 9 && !moved; ++attempt) {
        const VecX step = Step(damping);
        const VecX before = x_.edit.col(t);
        double share = 1;
        for (int shortening = 0; shortening < 3 && !moved; ++shortening) {
          x_.edit.col(t) = before + share * step;
          const NodePositions now = NodesAt(t);
          const double length = LargestDisplacement(accepted, now);
          if (length > options_.step_limit_m) {
            share *= 0.95 * options_.step_limit_m / length;
            continue;
          }
          const bool sound = Sound(accepted, now, previous);
          const double next = sound ? Cost(t, follow, previous >= 0) : 0;
          if (sound && next < cost) {
            moved = true;
            decrease = (cost - next) / cost;
            cost = next;
            accepted = now;
          } else {
            share *= 0.3;
          }
        }
        if (!moved) x_.edit.col(t) = before;
        damping = moved ? std::max(damping * 0.2, 1e-4) : damping * 10;
      }
      if (!moved || decrease < 1e-3) break;
    }
    SetFrame(t, false);  // free anchors stay where the frame ended
    last_ = accepted;
  }

  const Unknowns& unknowns() const { return x_; }

 private:
  NodePositions NodesAt(int t) {
    frame_.Set(scene_, x_, t, false);
    return {frame_.posed[0].node, frame_.posed[1].node};
  }

  bool Sound(const NodePositions& accepted, const NodePositions& now, int previous) const {
    if (LargestGliJump(scene_.body, accepted, now, options_.guard_reach).size > options_.gli_jump)
      return false;
    return previous < 0 ||
           LargestGliJump(scene_.body, last_, now, options_.guard_reach).size <= options_.gli_jump;
  }

  // Gives frame t the edit that keeps the pose of `previous`.
  void KeepPose(int previous, int t) {
    Pose pose;
    for (int f = 0; f < 2; ++f) {
      const int first = scene_.FirstCoordinate(f);
      const std::vector<Pose>& source = scene_.source[f].frames;
      EditedPose(source[previous], x_.edit.col(previous).data() + first, &pose);
      EditOf(source[t], pose, x_.edit.col(t).data() + first);
    }
  }

  // Contacts that begin with this frame, in the pass's direction: their anchors are still free.
  void StartAnchors(int t, int previous) {
    free_anchors_.clear();
    int anchor = 0;
    for (int f = 0; f < 2; ++f) {
      for (const Contact& c : scene_.contacts[f]) {
        const bool here = c.first <= t && t <= c.last;
        const bool before = previous >= c.first && previous <= c.last;
        if (here && !before) free_anchors_.push_back({anchor, f, c.node});
        ++anchor;
      }
    }
  }

  // Works out frame t; free anchors go where their feet are.
  void SetFrame(int t, bool derivatives) {
    frame_.Set(scene_, x_, t, derivatives);
    for (const FreeAnchor& free : free_anchors_) {
      const Vec3& foot = frame_.posed[free.figure].node[free.node];
      x_.anchor.col(free.anchor) << foot.x(), foot.z();
    }
  }

  double Cost(int t, const VecX& follow, bool follows) {
    SetFrame(t, false);
    problem_.EvaluateFrame(frame_, 1, false, &rows_);
    double cost = rows_.HalfSquares();
    if (follows) {
      cost += 0.5 * options_.follow_weight * options_.follow_weight *
              (x_.edit.col(t) - follow).squaredNorm();
    }
    return cost;
  }

  void Linearise(int t, const VecX& follow, bool follows) {
    SetFrame(t, true);
    problem_.EvaluateFrame(frame_, 1, true, &rows_);
    NormalEquations(rows_, &hessian_, &gradient_);
    if (!follows) return;
    const double w2 = options_.follow_weight * options_.follow_weight;
    hessian_.diagonal().array() += w2;
    gradient_ += w2 * (x_.edit.col(t) - follow);
  }

  VecX Step(double damping) {
    const int n = static_cast<int>(gradient_.size());
    factor_ = hessian_;
    factor_.diagonal() += damping * hessian_.diagonal();
    factor_.diagonal().array() += 1e-12;
    VecX step = -gradient_;
    PartialCholesky(factor_.data(), n, n, n, 0, step.data());
    factor_.triangularView<Eigen::Lower>().transpose().solveInPlace(step);
    return step;
  }

  const Problem& problem_;
  const Scene& scene_;
  QuasiStaticOptions options_;
  Unknowns x_;
  struct FreeAnchor {
    int anchor, figure, node;
  };

  NodePositions last_;  // of the frame before
  std::vector<FreeAnchor> free_anchors_;
  Frame frame_;
  Rows rows_;
  MatX hessian_, factor_;
  VecX gradient_;
};

// Anchors go where their feet stand on average.
void CentreAnchors(const Scene& scene, Unknowns* x) {
  x->anchor = UnknownsFromPoses(scene, EditedClips(scene, *x)).anchor;
}

}  // namespace

Unknowns QuasiStaticPass(const Problem& problem, const Unknowns& start,
                         const QuasiStaticOptions& options) {
  const Scene& scene = problem.scene();
  const int middle = scene.template_frame;
  Pass forward(problem, start, options);
  forward.SolveFrame(middle, -1);
  Pass backward = forward;
  Pass* passes[2] = {&forward, &backward};
  ParallelFor(2, 2, [&](int k, int) {
    const int direction = k == 0 ? 1 : -1;
    for (int t = middle + direction; t >= 0 && t < scene.num_frames(); t += direction) {
      passes[k]->SolveFrame(t, t - direction);
    }
  });
  Unknowns out = forward.unknowns();
  out.edit.leftCols(middle) = backward.unknowns().edit.leftCols(middle);
  CentreAnchors(scene, &out);
  return out;
}

}  // namespace retarget::solver
