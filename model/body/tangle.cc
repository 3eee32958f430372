#include "model/body/tangle.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "model/geometry/polyline.h"

namespace retarget {
namespace {

// All paths of a body, shortest first, and how each is made shorter by one segment at either end.
struct PathList {
  std::vector<Path> paths;
  std::vector<int> length;                  // segments
  std::vector<std::array<int, 2>> shorter;  // path ids, -1 for the empty path

  explicit PathList(const Body& body) {
    const int n = body.num_nodes();
    for (int u = 0; u < n; ++u) {
      for (int v = u + 1; v < n; ++v) paths.push_back({u, v});
    }
    std::vector<std::vector<int>> nodes;
    for (const Path& path : paths) nodes.push_back(NodesOn(body, path));
    std::vector<int> order(paths.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int i, int j) { return nodes[i].size() < nodes[j].size(); });
    Eigen::MatrixXi id = Eigen::MatrixXi::Constant(n, n, -1);
    std::vector<Path> sorted;
    for (const int o : order) {
      const std::vector<int>& on = nodes[o];
      const size_t last = on.size() - 1;
      sorted.push_back(paths[o]);
      length.push_back(static_cast<int>(last));
      shorter.push_back({id(on[1], on[last]), id(on[0], on[last - 1])});
      const int index = static_cast<int>(sorted.size()) - 1;
      id(paths[o].from, paths[o].to) = id(paths[o].to, paths[o].from) = index;
    }
    paths = std::move(sorted);
  }
};

// G[n][m] = GLI(root -> n, root -> m), by prefix sums of the segment table. [na x nb]
MatX RootPathTable(const Body& a, const Body& b, const MatX& table) {
  MatX g = MatX::Zero(a.num_nodes(), b.num_nodes());
  for (int i = 1; i < a.num_nodes(); ++i) {
    const int pi = a.nodes[i].parent;
    for (int j = 1; j < b.num_nodes(); ++j) {
      const int pj = b.nodes[j].parent;
      // Inclusion-exclusion over the two last segments.
      g(i, j) = g(pi, j) + g(i, pj) - g(pi, pj) + table(i - 1, j - 1);
    }
  }
  return g;
}

double PathPairGli(const MatX& g, const Path& p, const Path& q) {
  return g(p.to, q.to) - g(p.from, q.to) - g(p.to, q.from) + g(p.from, q.from);
}

// Squared norm of a gradient given at nodes, over the body's coordinates: the root's translation
// and a turn about every joint centre (any orthonormal axes, so the world's).
double CoordinateNorm2(const Body& body, const PosedBody& posed, const std::vector<int>& nodes,
                       const std::vector<Vec3>& gradient) {
  Vec3 translation = Vec3::Zero();
  std::vector<Vec3> turn(body.links.size(), Vec3::Zero());
  for (size_t i = 0; i < nodes.size(); ++i) {
    translation += gradient[i];
    for (int l = body.nodes[nodes[i]].link; l >= 0; l = body.links[l].parent) {
      turn[l] += (posed.node[nodes[i]] - posed.centre[l]).cross(gradient[i]);
    }
  }
  double sum = translation.squaredNorm();
  for (const Vec3& t : turn) sum += t.squaredNorm();
  return sum;
}

// What crosses what, and how strongly, in the tangle's own sense: max(0, s p_i q_j G_ij),
// flattened.
VecX CrossingVector(const Body& a, const Body& b, const MatX& table, const Tangle& tangle) {
  const Eigen::VectorXd p = SignsOf(a, tangle.a).cast<double>();
  const Eigen::VectorXd q = SignsOf(b, tangle.b).cast<double>();
  const double sign = tangle.gli < 0 ? -1 : 1;
  const MatX crossing = (sign * (p.asDiagonal() * table * q.asDiagonal())).cwiseMax(0.0);
  return Eigen::Map<const VecX>(crossing.data(), crossing.size()).normalized();
}

}  // namespace

std::string TangleText(const Body& a, const Body& b, const Tangle& tangle) {
  const auto path = [](const char* figure, const Body& body, const Path& p) {
    std::string text = figure;
    text.append(" (").append(body.nodes[p.from].name).append(", ");
    return text.append(body.nodes[p.to].name).append(")");
  };
  return path("a", a, tangle.a).append(" x ").append(path("b", b, tangle.b));
}

std::vector<Tangle> FindTangles(const Body& a, const Body& b, const MatX& table) {
  const PathList pa(a), pb(b);
  const MatX g = RootPathTable(a, b, table);
  const int na = static_cast<int>(pa.paths.size()), nb = static_cast<int>(pb.paths.size());
  MatX largest(na, nb);  // over the pair and all its sub-pairs
  std::vector<Tangle> found;
  for (int i = 0; i < na; ++i) {
    for (int j = 0; j < nb; ++j) {
      const double gli = PathPairGli(g, pa.paths[i], pb.paths[j]);
      double below = 0;
      for (const int s : pa.shorter[i]) {
        if (s >= 0) below = std::max(below, largest(s, j));
      }
      for (const int s : pb.shorter[j]) {
        if (s >= 0) below = std::max(below, largest(i, s));
      }
      if (std::abs(gli) > kTangleThreshold && std::abs(gli) > below + kTangleTie) {
        found.push_back({pa.paths[i], pb.paths[j], gli});
      }
      largest(i, j) = std::max(below, std::abs(gli));
    }
  }
  return found;
}

std::vector<Tangle> FindTanglesByDefinition(const Body& a, const Body& b, const MatX& table) {
  const MatX g = RootPathTable(a, b, table);
  const auto beaten_by_sub_path = [&](const std::vector<int>& p, const std::vector<int>& q,
                                      double gli) {
    for (size_t i = 0; i < p.size(); ++i) {
      for (size_t k = i + 1; k < p.size(); ++k) {
        for (size_t j = 0; j < q.size(); ++j) {
          for (size_t l = j + 1; l < q.size(); ++l) {
            if (k - i == p.size() - 1 && l - j == q.size() - 1) continue;
            const double sub = PathPairGli(g, {p[i], p[k]}, {q[j], q[l]});
            if (std::abs(gli) <= std::abs(sub) + kTangleTie) return true;
          }
        }
      }
    }
    return false;
  };
  std::vector<Tangle> found;
  for (int u = 0; u < a.num_nodes(); ++u) {
    for (int v = u + 1; v < a.num_nodes(); ++v) {
      const std::vector<int> p = NodesOn(a, {u, v});
      for (int x = 0; x < b.num_nodes(); ++x) {
        for (int y = x + 1; y < b.num_nodes(); ++y) {
          const double gli = PathPairGli(g, {u, v}, {x, y});
          if (std::abs(gli) <= kTangleThreshold) continue;
          if (!beaten_by_sub_path(p, NodesOn(b, {x, y}), gli))
            found.push_back({{u, v}, {x, y}, gli});
        }
      }
    }
  }
  return found;
}

PosedBody PosedFromNodes(const Body& body, const std::vector<Vec3>& nodes) {
  assert(nodes.size() == body.nodes.size());
  PosedBody posed;
  posed.node = nodes;
  posed.rotation.assign(body.links.size(), Mat3::Identity());
  posed.centre.assign(body.links.size(), Vec3::Zero());
  for (int n = body.num_nodes() - 1; n >= 0; --n) {
    // The link that carries a node turns about the node's parent (a root's own node carries
    // itself).
    const int parent = body.nodes[n].parent;
    const int link = body.nodes[n].link;
    posed.centre[link] = link == 0 ? nodes[0] : nodes[parent];
  }
  return posed;
}

double TangleGradientNorm(const Body& a, const PosedBody& posed_a, const Body& b,
                          const PosedBody& posed_b, const Tangle& tangle) {
  const std::vector<int> p = NodesOn(a, tangle.a), q = NodesOn(b, tangle.b);
  const PathGli gli = PolylineGliGradient(PointsOn(posed_a.node, p), PointsOn(posed_b.node, q));
  return std::sqrt(CoordinateNorm2(a, posed_a, p, gli.gradient_p) +
                   CoordinateNorm2(b, posed_b, q, gli.gradient_q));
}

std::vector<Tag> ReduceTangles(const Body& a, const PosedBody& posed_a, const Body& b,
                               const PosedBody& posed_b, const std::vector<Tangle>& literal,
                               const MatX& table, const ReductionOptions& options) {
  struct Candidate {
    Tag tag;
    VecX crossing;
    int segments;
  };
  std::vector<Candidate> left;
  for (const Tangle& tangle : literal) {
    const double norm = TangleGradientNorm(a, posed_a, b, posed_b, tangle);
    const double rho = (std::abs(tangle.gli) - kTangleThreshold) / std::max(norm, 1e-12);
    const int segments =
        static_cast<int>(NodesOn(a, tangle.a).size() + NodesOn(b, tangle.b).size());
    left.push_back({{tangle, rho, 1}, CrossingVector(a, b, table, tangle), segments});
  }
  std::stable_sort(left.begin(), left.end(),
                   [](const Candidate& x, const Candidate& y) { return x.tag.rho > y.tag.rho; });
  std::vector<Tag> tags;
  while (!left.empty() && static_cast<int>(tags.size()) < options.max_tags) {
    const Candidate best = left.front();
    const bool weak = !tags.empty() &&
                      best.tag.rho < std::max(options.min_rho, options.min_rho_share * tags[0].rho);
    if (weak) break;
    Candidate chosen = best;
    std::vector<Candidate> others;
    for (const Candidate& c : left) {
      if (c.crossing.dot(best.crossing) <= options.same_crossings) {
        others.push_back(c);
      } else if (c.tag.rho >= options.keep_rho * best.tag.rho && c.segments < chosen.segments) {
        chosen = c;
      }
    }
    chosen.tag.group_size = static_cast<int>(left.size() - others.size());
    tags.push_back(chosen.tag);
    left = std::move(others);
  }
  return tags;
}

}  // namespace retarget
