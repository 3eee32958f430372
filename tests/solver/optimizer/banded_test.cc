// The block elimination with travelling anchors against a dense solve of the same system.
#include "solver/optimizer/banded.h"

#include <gtest/gtest.h>

#include <random>

#include "solver/problem/smoothness.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

struct RandomSystem {
  int frames, n;
  std::vector<AnchorSpan> spans;
  VecX stencil;
  std::vector<MatX> jacobian;  // [rows x n] per frame
  std::vector<VecX> residual;
  std::vector<std::vector<int>> standing;
  std::vector<MatX> mix;  // M of each frame

  RandomSystem(int frames_, int n_, std::vector<AnchorSpan> spans_)
      : frames(frames_), n(n_), spans(std::move(spans_)) {
    std::mt19937 random(5);
    stencil = RandomMatrix(n, 1, &random).cwiseAbs() * 30;
    for (int t = 0; t < frames; ++t) {
      std::vector<int> here;
      for (size_t k = 0; k < spans.size(); ++k) {
        if (spans[k].first <= t && t <= spans[k].last) here.push_back(static_cast<int>(k));
      }
      standing.push_back(here);
      jacobian.push_back(
          RandomMatrix(n + 3 + kAnchorSize * static_cast<long>(here.size()), n, &random));
      residual.push_back(RandomMatrix(jacobian.back().rows(), 1, &random));
      const long m = kAnchorSize * static_cast<long>(here.size());
      mix.push_back(MatX::Identity(m, m) + 0.4 * RandomMatrix(m, m, &random));
    }
  }

  // The last rows of a frame are r = J x - M anchors, two per standing anchor: a foot between two
  // footprints reads both.
  void Assemble(int t, FrameBlock* block) const {
    const MatX& j = jacobian[t];
    block->hessian = (j.transpose() * j).triangularView<Eigen::Lower>();
    block->gradient = j.transpose() * residual[t];
    block->anchors = standing[t];
    const long m = kAnchorSize * static_cast<long>(standing[t].size());
    block->anchor_coupling = -mix[t].transpose() * j.bottomRows(m);
    block->anchor_hessian = mix[t].transpose() * mix[t];
    block->anchor_gradient = -mix[t].transpose() * residual[t].tail(m);
  }

  VecX DenseSolve(const VecX& damping) const {
    const long size = static_cast<long>(frames) * n + kAnchorSize * static_cast<long>(spans.size());
    MatX h = MatX::Zero(size, size);
    VecX g = VecX::Zero(size);
    for (int t = 0; t < frames; ++t) {
      MatX j = MatX::Zero(jacobian[t].rows(), size);
      j.middleCols(t * n, n) = jacobian[t];
      const long m = kAnchorSize * static_cast<long>(standing[t].size());
      for (long k = 0; k < m; ++k) {
        j.block(jacobian[t].rows() - m,
                frames * n + kAnchorSize * standing[t][k / kAnchorSize] + k % kAnchorSize, m, 1) =
            -mix[t].col(k);
      }
      h += j.transpose() * j;
      g += j.transpose() * residual[t];
      for (int lag = 0; lag <= 2 && t + lag < frames; ++lag) {
        const VecX s = Smoothness::StencilProduct(frames, t, lag) * stencil;
        h.block(t * n, (t + lag) * n, n, n).diagonal() += s;
        if (lag > 0) h.block((t + lag) * n, t * n, n, n).diagonal() += s;
      }
    }
    for (int t = 0; t < frames; ++t) {
      h.diagonal().segment(t * n, n) *= 1 + damping[t];
    }
    return h.ldlt().solve(-g);
  }
};

void Compare(int frames, int n, const std::vector<AnchorSpan>& spans, int threads) {
  const RandomSystem system(frames, n, spans);
  std::mt19937 random(6);
  const VecX damping = RandomMatrix(frames, 1, &random).cwiseAbs();
  const VecX expected = system.DenseSolve(damping);
  BandedSystem banded(frames, spans, system.stencil);
  BandedStep step;
  ASSERT_TRUE(banded.Solve([&](int t, int, FrameBlock* block) { system.Assemble(t, block); },
                           damping, threads, &step));
  for (int t = 0; t < frames; ++t) {
    for (int c = 0; c < n; ++c) {
      EXPECT_NEAR(step.frames(c, t), expected[t * n + c], 1e-7) << frames << " frames";
    }
  }
  for (size_t k = 0; k < spans.size(); ++k) {
    for (int c = 0; c < kAnchorSize; ++c) {
      EXPECT_NEAR(step.anchors(c, k), expected[frames * n + kAnchorSize * static_cast<long>(k) + c],
                  1e-6);
    }
  }
}

TEST(BandedSystem, MatchesADenseSolveWithoutAnchors) {
  for (const int frames : {1, 2, 3, 4, 5, 6, 9, 16}) Compare(frames, 7, {}, 2);
}

TEST(BandedSystem, MatchesADenseSolveWithAnchorsThatStartEndAndCrossTheMiddle) {
  Compare(1, 5, {{0, 0}}, 1);
  Compare(4, 5, {{0, 1}, {2, 3}, {0, 3}}, 2);
  Compare(15, 6, {{0, 4}, {2, 2}, {3, 11}, {5, 9}, {6, 7}, {10, 14}, {0, 14}}, 2);
  Compare(16, 6, {{0, 6}, {7, 8}, {8, 8}, {9, 15}, {1, 14}}, 1);
}

TEST(BandedSystem, ThreadsDoNotChangeTheResult) {
  const RandomSystem system(20, 6, {{0, 12}, {4, 19}});
  const VecX damping = VecX::Constant(20, 0.01);
  std::array<BandedStep, 2> step;
  for (int threads : {1, 2}) {
    BandedSystem banded(20, system.spans, system.stencil);
    ASSERT_TRUE(banded.Solve([&](int t, int, FrameBlock* block) { system.Assemble(t, block); },
                             damping, threads, &step[threads - 1]));
  }
  EXPECT_EQ(step[0].frames, step[1].frames);
  EXPECT_EQ(step[0].anchors, step[1].anchors);
}

}  // namespace
}  // namespace retarget::solver
