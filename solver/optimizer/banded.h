// The linear system of one Gauss-Newton step over a clip, solved by block Cholesky.
//
// Unknowns are frames (blocks of equal size, coupled to the next two frames by the smoothness
// stencil) and anchors (the place of a planted foot, coupled to all frames of its contact).
// Frames are eliminated one after the other. An anchor travels with the front from the first frame
// of its contact and is eliminated with the last, so the cost stays linear in the number of frames
// and exact. The clip is eliminated from both ends at once, in two threads, towards two frames in
// its middle (a frontal method: Duff and Reid 1983).
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "model/geometry/types.h"

namespace retarget::solver {

// Coordinates of an anchor: x and z.
inline constexpr int kAnchorSize = 2;

// What one frame brings to the normal equations J^T J x = -J^T r.
struct FrameBlock {
  MatX hessian;   // [n x n], lower triangle
  VecX gradient;  // J^T r [n]
  // Anchors that stand in this frame: their rows of J^T J and J^T r.
  std::vector<int> anchors;
  MatX anchor_coupling;  // [2 anchors x n]
  MatX anchor_hessian;   // [2 anchors x 2 anchors]
  VecX anchor_gradient;  // [2 anchors]
};

// The frames of an anchor's contact, both included.
struct AnchorSpan {
  int first, last;
};

struct BandedStep {
  MatX frames;           // [n x frames]
  MatX anchors;          // [2 x anchors]
  MatX diagonal;         // of J^T J, undamped [n x frames]
  MatX gradient;         // J^T r [n x frames]
  MatX anchor_gradient;  // [2 x anchors]
};

class BandedSystem {
 public:
  // `stencil` are the squared smoothness weights per coordinate [n].
  BandedSystem(int num_frames, std::vector<AnchorSpan> anchors, VecX stencil);

  // Fills the block of a frame; called from two threads (0 and 1), once per frame.
  using Assemble = std::function<void(int frame, int thread, FrameBlock* block)>;

  // Solves (J^T J + diag(damping_t diag(J^T J)_t)) x = -J^T r. False where the matrix is not
  // positive definite. `damping` has one entry per frame.
  bool Solve(const Assemble& assemble, const VecX& damping, int threads, BandedStep* step);

  // What the factorisation keeps (bytes).
  size_t memory_bytes() const;

 private:
  // A dense symmetric matrix (lower triangle) and right-hand side over a list of variables: frames
  // are 0 .. frames - 1, anchors follow. Once its first `eliminated` variables are gone, the rest
  // is what the next front inherits.
  struct Front {
    std::vector<int> variables;
    std::vector<int> offset;
    MatX matrix;
    VecX rhs;
    int size = 0;
    size_t eliminated = 0;
  };
  // The eliminated part of a front: L over [own; rest] x own, and its right-hand side.
  struct Factor {
    std::vector<int> variables;  // own first
    std::vector<int> offset;
    int own = 0;  // scalars
    MatX l;       // [own + rest] x own
    VecX y;       // [own]
  };
  // One of the two directions of elimination.
  struct Chain {
    int direction = 1;
    int thread = 0;
    std::vector<int> frames;  // in order of elimination
    Front front;              // the last one eliminated
    Front next;               // the one being built
    FrameBlock block;
    MatX anchor_gradient;
    bool failed = false;
  };

  int SizeOf(int variable) const { return variable < num_frames_ ? n_ : kAnchorSize; }
  void Start(const std::vector<int>& variables, Front* front) const;
  static int Find(const Front& front, int variable);
  void Inherit(const Front& from, Front* front) const;
  void AddFrame(int frame, double damping, const FrameBlock& block, Front* front, Chain* chain,
                BandedStep* step) const;
  void AddStencil(int from, int to, Front* front) const;
  bool Eliminate(size_t own_variables, Front* front, Factor* factor) const;
  std::vector<int> StandingAnchors(const Front& inherited, const FrameBlock& block) const;
  void Run(const Assemble& assemble, const VecX& damping, BandedStep* step, Chain* chain);
  bool SolveMiddle(const Assemble& assemble, const VecX& damping, BandedStep* step);
  void BackSubstitute(const Factor& factor, BandedStep* step) const;

  int num_frames_, n_;
  std::vector<AnchorSpan> anchors_;
  VecX stencil_;
  std::vector<int> middle_;  // the last frames, eliminated together
  Chain chain_[2];
  std::vector<Factor> factor_;  // by frame; that of the middle at middle_[0]
};

}  // namespace retarget::solver
