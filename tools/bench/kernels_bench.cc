// The inner loops by themselves, on the shipped hold posture. `per_pair` is the time of one segment
// pair; GFLOP/s are to be compared with DenseMultiply's in the same run. Rates count cpu time,
// which a busy machine disturbs less.
#include <benchmark/benchmark.h>

#include <array>
#include <string>
#include <vector>

#include "io/template_file.h"
#include "model/body/tangle.h"
#include "model/geometry/capsule.h"
#include "model/geometry/gli.h"
#include "model/geometry/polyline.h"
#include "solver/optimizer/kernels.h"
#include "solver/problem/terms/tangle.h"
#include "tools/bench/multiply.h"

namespace retarget {
namespace {

using benchmark::Counter;
using benchmark::DoNotOptimize;

// The hold, posed: input of everything here.
struct Hold {
  TemplatePosture posture;
  std::array<PosedBody, 2> posed;

  const std::vector<Vec3>& nodes(int figure) const { return posed[figure].node; }
  MatX Table() const {
    return SegmentGliTable(posture.body[0], nodes(0), posture.body[1], nodes(1));
  }
};

const Hold& TheHold() {
  static const Hold hold = [] {
    Hold h;
    h.posture = io::ReadTemplate(std::string(RETARGET_EXAMPLE_DIR) + "/template.yaml");
    for (int f = 0; f < 2; ++f) h.posed[f] = PoseBody(h.posture.body[f], h.posture.pose[f]);
    return h;
  }();
  return hold;
}

struct SegmentPair {
  Vec3 a, b, c, d;
};

// Every segment of one figure with every segment of the other.
std::vector<SegmentPair> AllPairs() {
  const Hold& hold = TheHold();
  std::vector<SegmentPair> pairs;
  for (int i = 1; i < hold.posture.body[0].num_nodes(); ++i) {
    for (int j = 1; j < hold.posture.body[1].num_nodes(); ++j) {
      const int pi = hold.posture.body[0].nodes[i].parent,
                pj = hold.posture.body[1].nodes[j].parent;
      pairs.push_back({hold.nodes(0)[pi], hold.nodes(0)[i], hold.nodes(1)[pj], hold.nodes(1)[j]});
    }
  }
  return pairs;
}

// Seconds per item, for iterations over `items` items.
Counter PerItem(size_t items) {
  return Counter(static_cast<double>(items), Counter::kIsIterationInvariantRate | Counter::kInvert);
}

Counter GigaflopRate(double flops) {
  return Counter(1e-9 * flops, Counter::kIsIterationInvariantRate);
}

template <typename Kernel>
void ForAllPairs(benchmark::State& state, const Kernel& kernel) {
  const std::vector<SegmentPair> pairs = AllPairs();
  for (auto _ : state) {
    for (const SegmentPair& p : pairs) DoNotOptimize(kernel(p));
  }
  state.counters["per_pair"] = PerItem(pairs.size());
}

void SegmentGliValue(benchmark::State& state) {
  ForAllPairs(state, [](const SegmentPair& p) { return SegmentGli(p.a, p.b, p.c, p.d); });
}
BENCHMARK(SegmentGliValue);

void SegmentGliAndGradient(benchmark::State& state) {
  ForAllPairs(state,
              [](const SegmentPair& p) { return SegmentGliWithGradient(p.a, p.b, p.c, p.d); });
}
BENCHMARK(SegmentGliAndGradient);

void CapsulePair(benchmark::State& state) {
  ForAllPairs(state, [](const SegmentPair& p) {
    return CapsuleDepth(ClosestPointsOfSegments(p.a, p.b, p.c, p.d), 0.05, 0.05);
  });
}
BENCHMARK(CapsulePair);

// From hand to hand: eight segments.
Path HandToHand(const Body& body) {
  return {body.FindNode("left_hand"), body.FindNode("right_hand")};
}

std::vector<Vec3> HandToHandPoints(int figure) {
  const Body& body = TheHold().posture.body[figure];
  std::vector<Vec3> points;
  for (const int n : NodesOn(body, HandToHand(body))) points.push_back(TheHold().nodes(figure)[n]);
  return points;
}

// The geometry of a path-pair residual: value and gradient by the points.
void PathPair8x8(benchmark::State& state) {
  const std::vector<Vec3> p = HandToHandPoints(0), q = HandToHandPoints(1);
  for (auto _ : state) DoNotOptimize(PolylineGliWithGradient(p, q));
  state.counters["segments"] = Counter(static_cast<double>((p.size() - 1) * (q.size() - 1)));
}
BENCHMARK(PathPair8x8);

// The whole residual: also the chain rule to the 120 coordinates of the frame.
void TangleResidual8x8(benchmark::State& state) {
  solver::Scene scene;
  scene.body = TheHold().posture.body;
  for (int f = 0; f < 2; ++f) scene.source[f].frames = {TheHold().posture.pose[f]};
  solver::TangleTarget held;
  held.tag.tangle = {HandToHand(scene.body[0]), HandToHand(scene.body[1]), 0};
  held.target = 10;  // out of reach, so that the hinge is always active
  scene.tangles = {held};
  const solver::TangleTerm term(scene);
  const solver::Unknowns still = {MatX::Zero(scene.num_coordinates(), 1), MatX::Zero(3, 0)};
  solver::Frame frame;
  frame.Set(scene, still, 0, true);
  solver::Rows rows;
  for (auto _ : state) {
    rows.Reset(frame, true);
    term.Evaluate(frame, &rows);
    benchmark::ClobberMemory();
  }
}
BENCHMARK(TangleResidual8x8);

void SegmentTable(benchmark::State& state) {
  for (auto _ : state) DoNotOptimize(TheHold().Table());
}
BENCHMARK(SegmentTable)->Unit(benchmark::kMicrosecond);

// Detection from node positions: the table of segment pairs, then Algorithm 1.
template <auto Find>
void Detection(benchmark::State& state) {
  const TemplatePosture& posture = TheHold().posture;
  size_t found = 0;
  for (auto _ : state) found = Find(posture.body[0], posture.body[1], TheHold().Table()).size();
  state.counters["tangles"] = Counter(static_cast<double>(found));
}
BENCHMARK(Detection<FindTangles>)->Name("Detection")->Unit(benchmark::kMillisecond);
BENCHMARK(Detection<FindTanglesByDefinition>)
    ->Name("DetectionByDefinition")
    ->Unit(benchmark::kMillisecond);

void NormalEquations(benchmark::State& state) {
  const int rows = static_cast<int>(state.range(0)), n = static_cast<int>(state.range(1));
  const MatX jt = MatX::Random(n, rows);
  const VecX r = VecX::Random(rows);
  MatX h = MatX::Zero(n, n);
  VecX g = VecX::Zero(n);
  for (auto _ : state) {
    solver::AddNormalEquations(jt.data(), r.data(), rows, n, h.data(), g.data());
    benchmark::ClobberMemory();
  }
  // One triangle, multiply and add, and J^T r.
  state.counters["GFLOP/s"] =
      GigaflopRate(static_cast<double>(rows) * n * (n + 1) + 2.0 * rows * n);
}
BENCHMARK(NormalEquations)->Args({60, 120})->Unit(benchmark::kMicrosecond);

// Multiplies and adds of eliminating `own` of `size` unknowns, one triangle.
double EliminationFlops(int size, int own) {
  double flops = 0;
  for (int k = 0; k < own; ++k) flops += static_cast<double>(size - k) * (size - k - 1);
  return flops;
}

void Elimination(benchmark::State& state) {
  const int size = static_cast<int>(state.range(0)), own = static_cast<int>(state.range(1));
  const MatX random = MatX::Random(size, size);
  const MatX original = random * random.transpose() + MatX::Identity(size, size);
  MatX a;
  VecX b;
  for (auto _ : state) {
    state.PauseTiming();
    a = original;
    b = VecX::Ones(size);
    state.ResumeTiming();
    DoNotOptimize(solver::PartialCholesky(a.data(), size, size, own, 120, b.data()));
  }
  state.counters["GFLOP/s"] = GigaflopRate(EliminationFlops(size, own));
}
// A front with eight anchors (24 scalars), and one without.
BENCHMARK(Elimination)->Args({384, 120})->Args({360, 120})->Unit(benchmark::kMicrosecond);

void DenseMultiply(benchmark::State& state) {
  const int m = static_cast<int>(state.range(0)), k = static_cast<int>(state.range(1));
  const MatX a = MatX::Random(m, k), b = MatX::Random(k, m);
  MatX c = MatX::Zero(m, m);
  for (auto _ : state) {
    Multiply(a.data(), b.data(), m, m, k, c.data());
    benchmark::ClobberMemory();
  }
  state.counters["GFLOP/s"] = GigaflopRate(MultiplyFlops(m, m, k));
}
BENCHMARK(DenseMultiply)->Args({264, 120})->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace retarget

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::AddCustomContext("kernels", retarget::KernelName());
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
