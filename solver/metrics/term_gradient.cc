#include "solver/metrics/term_gradient.h"

#include <algorithm>
#include <set>

namespace retarget::solver {
namespace {

class GradientSum {
 public:
  GradientSum(const Problem& problem, const Unknowns& unknowns, int first, int last,
              const std::vector<int>& coordinates)
      : problem_(problem),
        unknowns_(unknowns),
        first_(first),
        last_(last),
        coordinates_(coordinates) {}

  std::vector<TermGradient> Run() {
    for (const WeightedTerm& weighted : problem_.terms()) {
      if (weighted.weight == 0) continue;
      const int parts = weighted.term->parts(problem_.scene());
      for (int part = 0; part < parts; ++part) AddPart(*weighted.term, weighted.weight, part);
    }
    AddSmoothness();
    return std::move(gradients_);
  }

 private:
  void AddPart(const Term& term, double weight, int part) {
    const bool whole = term.part_kind() == PartKind::kWhole;
    TermGradient pull{term.name(), whole ? -1 : part, VecX::Zero(size())};
    int rows_seen = 0;
    for (int t = first_; t < last_; ++t) {
      frame_.Set(problem_.scene(), unknowns_, t, true);
      rows_.Reset(frame_, true);
      term.EvaluatePart(frame_, part, &rows_);
      VecX g = rows_.jacobian().transpose() *
               Eigen::Map<const VecX>(rows_.residual().data(), rows_.num_rows());
      for (const Rows::CoordinateRow& c : rows_.coordinates()) {
        g[c.coordinate] += c.derivative * c.residual;
      }
      Restrict(weight * weight * g, t, &pull);
      rows_seen += rows_.num_rows() + static_cast<int>(rows_.coordinates().size());
    }
    if (rows_seen > 0) gradients_.push_back(std::move(pull));
  }

  void AddSmoothness() {
    const Smoothness& smoothness = problem_.smoothness();
    for (const bool root : {false, true}) {
      TermGradient pull{root ? "root_smoothness" : "smoothness", -1, VecX::Zero(size())};
      for (int t = first_; t < last_; ++t) {
        VecX g = VecX::Zero(problem_.scene().num_coordinates());
        smoothness.AddGradient(unknowns_.edit, t, root, g);
        Restrict(g, t, &pull);
      }
      if (!pull.gradient.isZero(0)) gradients_.push_back(std::move(pull));
    }
  }

  void Restrict(const VecX& g, int t, TermGradient* pull) const {
    const long n = static_cast<long>(coordinates_.size());
    for (long c = 0; c < n; ++c) {
      pull->gradient[(t - first_) * n + c] = g[coordinates_[static_cast<size_t>(c)]];
    }
  }

  long size() const { return (last_ - first_) * static_cast<long>(coordinates_.size()); }

  const Problem& problem_;
  const Unknowns& unknowns_;
  int first_, last_;
  const std::vector<int>& coordinates_;
  Frame frame_;
  Rows rows_;
  std::vector<TermGradient> gradients_;
};

}  // namespace

std::vector<TermGradient> TermGradients(const Problem& problem, const Unknowns& unknowns, int first,
                                        int last, const std::vector<int>& coordinates) {
  return GradientSum(problem, unknowns, first, last, coordinates).Run();
}

std::vector<int> CoordinatesOf(const Scene& scene, const std::vector<LimbNode>& limbs) {
  std::set<int> coordinates;
  for (const LimbNode& limb : limbs) {
    const Body& body = scene.body[limb.figure];
    const int first = scene.FirstCoordinate(limb.figure);
    for (int k = 0; k < 3; ++k) coordinates.insert(first + k);
    for (int l = body.nodes[limb.node].link; l >= 0; l = body.links[l].parent) {
      if (body.links[l].locked) continue;
      for (int k = 0; k < 3; ++k) coordinates.insert(first + 3 + 3 * l + k);
    }
  }
  return {coordinates.begin(), coordinates.end()};
}

}  // namespace retarget::solver
