#include "solver/metrics/term_gradient.h"

#include <algorithm>
#include <set>

#include "solver/problem/terms/foot_lock.h"
#include "solver/problem/terms/hold.h"
#include "solver/problem/terms/tangle.h"

namespace retarget::solver {
namespace {

class Puller {
 public:
  Puller(const Problem& problem, const Unknowns& unknowns, int first, int last,
         const std::vector<int>& coordinates)
      : problem_(problem),
        part_(problem.scene()),
        unknowns_(unknowns),
        first_(first),
        last_(last),
        coordinates_(coordinates) {}

  std::vector<Pull> Run() {
    const Scene& scene = problem_.scene();
    for (const auto& [term, weight] : problem_.terms()) {
      if (weight == 0) continue;
      const std::string name = term->name();
      if (name == "hold") {
        for (size_t k = 0; k < scene.holds.size(); ++k) {
          part_.holds = {scene.holds[k]};
          Add(*term, weight, static_cast<int>(k));
        }
      } else if (name == "tangle") {
        for (size_t k = 0; k < scene.tangles.size(); ++k) {
          part_.tangles = {scene.tangles[k]};
          Add(TangleTerm(part_), weight, static_cast<int>(k));
        }
      } else if (name == "foot_lock") {
        AddFeet(weight);
      } else {
        Add(*term, weight, -1);
      }
    }
    AddSmoothness();
    return std::move(pulls_);
  }

 private:
  // One contact at a time, with its anchor.
  void AddFeet(double weight) {
    const Scene& scene = problem_.scene();
    const MatX anchors = unknowns_.anchor;
    int anchor = 0;
    for (int f = 0; f < 2; ++f) {
      for (const Contact& contact : scene.contacts[f]) {
        part_.contacts = {};
        part_.contacts[f] = {contact};
        unknowns_.anchor = anchors.col(anchor);
        if (contact.first < last_ && contact.last >= first_) Add(FootLock(part_), weight, anchor);
        ++anchor;
      }
    }
    part_.contacts = scene.contacts;
    unknowns_.anchor = anchors;
  }

  void Add(const Term& term, double weight, int item) {
    Pull pull{term.name(), item, VecX::Zero(size())};
    int rows_seen = 0;
    for (int t = first_; t < last_; ++t) {
      frame_.Set(part_, unknowns_, t, true);
      rows_.Reset(frame_, true);
      term.Evaluate(frame_, &rows_);
      VecX g = rows_.jacobian().transpose() *
               Eigen::Map<const VecX>(rows_.residual().data(), rows_.num_rows());
      for (const Rows::CoordinateRow& c : rows_.coordinates()) {
        g[c.coordinate] += c.derivative * c.residual;
      }
      Restrict(weight * weight * g, t, &pull);
      rows_seen += rows_.num_rows() + static_cast<int>(rows_.coordinates().size());
    }
    if (rows_seen > 0) pulls_.push_back(std::move(pull));
  }

  void AddSmoothness() {
    const Smoothness& smoothness = problem_.smoothness();
    for (const bool root : {false, true}) {
      Pull pull{root ? "root_smoothness" : "smoothness", -1, VecX::Zero(size())};
      for (int t = first_; t < last_; ++t) {
        VecX g = VecX::Zero(problem_.scene().num_coordinates());
        smoothness.AddGradient(unknowns_.edit, t, g);
        for (int c = 0; c < g.size(); ++c) {
          if (smoothness.IsRoot(c) != root) g[c] = 0;
        }
        Restrict(g, t, &pull);
      }
      if (!pull.gradient.isZero(0)) pulls_.push_back(std::move(pull));
    }
  }

  void Restrict(const VecX& g, int t, Pull* pull) const {
    const long n = static_cast<long>(coordinates_.size());
    for (long c = 0; c < n; ++c) {
      pull->gradient[(t - first_) * n + c] = g[coordinates_[static_cast<size_t>(c)]];
    }
  }

  long size() const { return (last_ - first_) * static_cast<long>(coordinates_.size()); }

  const Problem& problem_;
  Scene part_;         // the scene with one hold, tag or contact at a time
  Unknowns unknowns_;  // with the anchors of part_
  int first_, last_;
  const std::vector<int>& coordinates_;
  Frame frame_;
  Rows rows_;
  std::vector<Pull> pulls_;
};

}  // namespace

std::vector<Pull> PullsOn(const Problem& problem, const Unknowns& unknowns, int first, int last,
                          const std::vector<int>& coordinates) {
  return Puller(problem, unknowns, first, last, coordinates).Run();
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
