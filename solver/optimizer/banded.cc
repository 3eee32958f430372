#include "solver/optimizer/banded.h"

#include <algorithm>
#include <cassert>

#include "solver/optimizer/kernels.h"
#include "solver/problem/parallel.h"
#include "solver/problem/smoothness.h"

namespace retarget::solver {
namespace {
// Keeps the block of an anchor positive definite where its foot has no weight.
constexpr double kTinyPivot = 1e-9;
}  // namespace

BandedSystem::BandedSystem(int num_frames, std::vector<AnchorSpan> anchors, VecX stencil)
    : num_frames_(num_frames),
      n_(static_cast<int>(stencil.size())),
      anchors_(std::move(anchors)),
      stencil_(std::move(stencil)),
      factor_(static_cast<size_t>(num_frames)) {
  const int m = std::max(0, num_frames / 2 - 1);
  for (int t = m; t < std::min(m + 2, num_frames); ++t) middle_.push_back(t);
  for (int t = 0; t < m; ++t) chain_[0].frames.push_back(t);
  for (int t = num_frames - 1; t > middle_.back(); --t) chain_[1].frames.push_back(t);
  chain_[1].direction = -1;
  chain_[1].thread = 1;
}

void BandedSystem::Start(const std::vector<int>& variables, Front* front) const {
  front->variables = variables;
  front->offset.clear();
  front->size = 0;
  for (const int v : variables) {
    front->offset.push_back(front->size);
    front->size += SizeOf(v);
  }
  front->eliminated = 0;
  if (front->matrix.rows() < front->size) front->matrix.resize(front->size, front->size);
  for (int c = 0; c < front->size; ++c) {
    front->matrix.col(c).segment(c, front->size - c).setZero();
  }
  front->rhs.setZero(front->size);
}

int BandedSystem::Find(const Front& front, int variable) {
  const auto at = std::find(front.variables.begin(), front.variables.end(), variable);
  assert(at != front.variables.end());
  return front.offset[static_cast<size_t>(at - front.variables.begin())];
}

// Extend-add: what is left of an eliminated front into the next one, whose order may differ.
void BandedSystem::Inherit(const Front& from, Front* front) const {
  for (size_t i = from.eliminated; i < from.variables.size(); ++i) {
    const int si = SizeOf(from.variables[i]);
    const int from_i = from.offset[i], to_i = Find(*front, from.variables[i]);
    front->rhs.segment(to_i, si) += from.rhs.segment(from_i, si);
    front->matrix.block(to_i, to_i, si, si).triangularView<Eigen::Lower>() +=
        from.matrix.block(from_i, from_i, si, si);
    for (size_t j = from.eliminated; j < i; ++j) {
      const int sj = SizeOf(from.variables[j]);
      const int to_j = Find(*front, from.variables[j]);
      const auto block = from.matrix.block(from_i, from.offset[j], si, sj);
      if (to_i > to_j) {
        front->matrix.block(to_i, to_j, si, sj) += block;
      } else {
        front->matrix.block(to_j, to_i, sj, si) += block.transpose();
      }
    }
  }
}

void BandedSystem::AddStencil(int from, int to, Front* front) const {
  const int lag = std::abs(to - from);
  const double c = Smoothness::StencilProduct(num_frames_, std::min(from, to), lag);
  const int i = Find(*front, from), j = Find(*front, to);
  front->matrix.block(std::max(i, j), std::min(i, j), n_, n_).diagonal() += c * stencil_;
}

void BandedSystem::AddFrame(int frame, double damping, const FrameBlock& block, Front* front,
                            Chain* chain, BandedStep* step) const {
  const int at = Find(*front, frame);
  auto own = front->matrix.block(at, at, n_, n_);
  own.triangularView<Eigen::Lower>() += block.hessian;
  own.diagonal() += Smoothness::StencilProduct(num_frames_, frame, 0) * stencil_;
  step->diagonal.col(frame) =
      block.hessian.diagonal() + Smoothness::StencilProduct(num_frames_, frame, 0) * stencil_;
  own.diagonal() += damping * step->diagonal.col(frame);
  front->rhs.segment(at, n_) -= block.gradient;
  step->gradient.col(frame) = block.gradient;
  for (size_t k = 0; k < block.anchors.size(); ++k) {
    const int row = kAnchorSize * static_cast<int>(k);
    const int to = Find(*front, num_frames_ + block.anchors[k]);
    if (to > at) {
      front->matrix.block(to, at, kAnchorSize, n_) +=
          block.anchor_coupling.middleRows(row, kAnchorSize);
    } else {
      front->matrix.block(at, to, n_, kAnchorSize) +=
          block.anchor_coupling.middleRows(row, kAnchorSize).transpose();
    }
    for (size_t other = 0; other < block.anchors.size(); ++other) {
      const int column = Find(*front, num_frames_ + block.anchors[other]);
      if (column > to) continue;  // the lower triangle
      front->matrix.block(to, column, kAnchorSize, kAnchorSize) +=
          block.anchor_hessian.block<kAnchorSize, kAnchorSize>(
              row, kAnchorSize * static_cast<int>(other));
    }
    front->matrix.block(to, to, kAnchorSize, kAnchorSize).diagonal().array() += kTinyPivot;
    front->rhs.segment(to, kAnchorSize) -= block.anchor_gradient.segment<kAnchorSize>(row);
    chain->anchor_gradient.col(block.anchors[k]) += block.anchor_gradient.segment<kAnchorSize>(row);
  }
}

bool BandedSystem::Eliminate(size_t own_variables, Front* front, Factor* factor) const {
  const bool all = own_variables == front->variables.size();
  const int own = all ? front->size : front->offset[own_variables];
  // The far neighbour comes last: what ties it to the frame is the stencil's diagonal alone.
  const int triangular = all ? 0 : n_;
  if (!PartialCholesky(front->matrix.data(), static_cast<int>(front->matrix.rows()), front->size,
                       own, triangular, front->rhs.data())) {
    return false;
  }
  front->eliminated = own_variables;
  factor->variables = front->variables;
  factor->offset = front->offset;
  factor->own = own;
  factor->l.resize(front->size, own);
  for (int c = 0; c < own; ++c) {
    factor->l.col(c).tail(front->size - c) = front->matrix.col(c).segment(c, front->size - c);
  }
  factor->y = front->rhs.head(own);
  return true;
}

// Anchors in a front: those inherited and those that stand in the frame.
std::vector<int> BandedSystem::StandingAnchors(const Front& inherited,
                                               const FrameBlock& block) const {
  std::vector<int> standing;
  for (size_t i = inherited.eliminated; i < inherited.variables.size(); ++i) {
    if (inherited.variables[i] >= num_frames_) standing.push_back(inherited.variables[i]);
  }
  for (const int k : block.anchors) standing.push_back(num_frames_ + k);
  std::sort(standing.begin(), standing.end());
  standing.erase(std::unique(standing.begin(), standing.end()), standing.end());
  return standing;
}

void BandedSystem::Run(const Assemble& assemble, const VecX& damping, BandedStep* step,
                       Chain* chain) {
  chain->failed = false;
  chain->anchor_gradient.setZero(kAnchorSize, static_cast<long>(anchors_.size()));
  Start({}, &chain->front);
  for (const int t : chain->frames) {
    assemble(t, chain->thread, &chain->block);
    const std::vector<int> standing = StandingAnchors(chain->front, chain->block);
    const auto ends_here = [&](int v) {
      const AnchorSpan& span = anchors_[static_cast<size_t>(v - num_frames_)];
      return (chain->direction > 0 ? span.last : span.first) == t;
    };
    std::vector<int> variables = {t};
    std::copy_if(standing.begin(), standing.end(), std::back_inserter(variables), ends_here);
    const size_t own = variables.size();
    variables.push_back(t + chain->direction);
    std::remove_copy_if(standing.begin(), standing.end(), std::back_inserter(variables), ends_here);
    variables.push_back(t + 2 * chain->direction);
    Start(variables, &chain->next);
    Inherit(chain->front, &chain->next);
    AddFrame(t, damping[t], chain->block, &chain->next, chain, step);
    AddStencil(t, t + chain->direction, &chain->next);
    AddStencil(t, t + 2 * chain->direction, &chain->next);
    if (!Eliminate(own, &chain->next, &factor_[static_cast<size_t>(t)])) {
      chain->failed = true;
      return;
    }
    std::swap(chain->front, chain->next);
  }
}

bool BandedSystem::SolveMiddle(const Assemble& assemble, const VecX& damping, BandedStep* step) {
  std::vector<FrameBlock> blocks(middle_.size());
  std::vector<int> standing;
  for (size_t k = 0; k < middle_.size(); ++k) {
    assemble(middle_[k], 0, &blocks[k]);
    for (const Chain& chain : chain_) {
      const std::vector<int> some = StandingAnchors(chain.front, blocks[k]);
      standing.insert(standing.end(), some.begin(), some.end());
    }
  }
  std::sort(standing.begin(), standing.end());
  standing.erase(std::unique(standing.begin(), standing.end()), standing.end());
  std::vector<int> variables = middle_;
  variables.insert(variables.end(), standing.begin(), standing.end());
  Front& front = chain_[0].next;
  Start(variables, &front);
  for (const Chain& chain : chain_) Inherit(chain.front, &front);
  for (size_t k = 0; k < middle_.size(); ++k) {
    AddFrame(middle_[k], damping[middle_[k]], blocks[k], &front, &chain_[0], step);
  }
  if (middle_.size() == 2) AddStencil(middle_[0], middle_[1], &front);
  return Eliminate(variables.size(), &front, &factor_[static_cast<size_t>(middle_[0])]);
}

void BandedSystem::BackSubstitute(const Factor& factor, BandedStep* step) const {
  const int size = static_cast<int>(factor.l.rows());
  VecX x(size);
  x.head(factor.own) = factor.y;
  for (size_t i = 0; i < factor.variables.size(); ++i) {
    if (factor.offset[i] < factor.own) continue;
    const int v = factor.variables[i];
    if (v < num_frames_) {
      x.segment(factor.offset[i], n_) = step->frames.col(v);
    } else {
      x.segment(factor.offset[i], kAnchorSize) = step->anchors.col(v - num_frames_);
    }
  }
  const int rest = size - factor.own;
  x.head(factor.own).noalias() -= factor.l.bottomRows(rest).transpose() * x.tail(rest);
  factor.l.topRows(factor.own)
      .triangularView<Eigen::Lower>()
      .transpose()
      .solveInPlace(x.head(factor.own));
  for (size_t i = 0; i < factor.variables.size() && factor.offset[i] < factor.own; ++i) {
    const int v = factor.variables[i];
    if (v < num_frames_) {
      step->frames.col(v) = x.segment(factor.offset[i], n_);
    } else {
      step->anchors.col(v - num_frames_) = x.segment(factor.offset[i], kAnchorSize);
    }
  }
}

bool BandedSystem::Solve(const Assemble& assemble, const VecX& damping, int threads,
                         BandedStep* step) {
  step->frames.resize(n_, num_frames_);
  step->diagonal.resize(n_, num_frames_);
  step->gradient.resize(n_, num_frames_);
  step->anchors.setZero(kAnchorSize, static_cast<long>(anchors_.size()));
  ParallelFor(2, threads, [&](int k, int) { Run(assemble, damping, step, &chain_[k]); });
  if (chain_[0].failed || chain_[1].failed) return false;
  if (!SolveMiddle(assemble, damping, step)) return false;
  step->anchor_gradient = chain_[0].anchor_gradient + chain_[1].anchor_gradient;
  BackSubstitute(factor_[static_cast<size_t>(middle_[0])], step);
  ParallelFor(2, threads, [&](int k, int) {
    for (auto t = chain_[k].frames.rbegin(); t != chain_[k].frames.rend(); ++t) {
      BackSubstitute(factor_[static_cast<size_t>(*t)], step);
    }
  });
  return true;
}

size_t BandedSystem::memory_bytes() const {
  size_t bytes = 0;
  for (const Factor& f : factor_)
    bytes += static_cast<size_t>(f.l.size() + f.y.size()) * sizeof(double);
  return bytes;
}

}  // namespace retarget::solver
