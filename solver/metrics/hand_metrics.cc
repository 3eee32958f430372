#include "solver/metrics/hand_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "model/body/hand_contact.h"

namespace retarget::solver {
namespace {

constexpr double kPercentile = 0.95;

// The segment of the hand that a node belongs to, its wrist counting as the hand; -1: none.
int HandOf(const Body& body, const HoldPoint& point) {
  if (point.figure == kWorld) return -1;
  for (const int hand : HandNodes(body)) {
    if (point.node == hand || point.node == body.nodes[hand].parent) return hand;
  }
  return -1;
}

// The segments that end or begin at a node.
std::vector<int> SegmentsAt(const Body& body, int node) {
  std::vector<int> segments;
  for (int n = 1; n < body.num_nodes(); ++n) {
    if (n == node || body.nodes[n].parent == node) segments.push_back(n);
  }
  return segments;
}

// Segments that share a node touch anyway.
bool SharesNode(const Body& body, int i, int j) {
  const int pi = body.nodes[i].parent, pj = body.nodes[j].parent;
  return i == j || i == pj || pi == j || pi == pj;
}

HoldingHand Holding(const MetricsContext& subject, int figure, int hand, int to_figure,
                    std::vector<int> to) {
  const Body& body = subject.body[figure];
  HoldingHand out{figure, {hand, body.nodes[hand].parent}, to_figure, std::move(to)};
  if (figure != to_figure) return out;
  const auto own = [&](int n) {
    return std::any_of(out.segments.begin(), out.segments.end(),
                       [&](int s) { return SharesNode(body, s, n); });
  };
  out.to.erase(std::remove_if(out.to.begin(), out.to.end(), own), out.to.end());
  return out;
}

}  // namespace

std::vector<HoldingHand> HoldingHands(const MetricsContext& subject) {
  std::vector<HoldingHand> hands;
  for (const Hold& hold : subject.holds) {
    if (hold.from.figure == kWorld || hold.to.figure == kWorld) continue;
    const HoldPoint *by = &hold.from, *held = &hold.to;
    if (HandOf(subject.body[by->figure], *by) < 0) std::swap(by, held);
    const int hand = HandOf(subject.body[by->figure], *by);
    if (hand < 0) continue;
    HoldingHand holding = Holding(subject, by->figure, hand, held->figure,
                                  SegmentsAt(subject.body[held->figure], held->node));
    if (!holding.to.empty()) hands.push_back(std::move(holding));
  }
  for (const HandContact& c : subject.hand_contacts) {
    hands.push_back(Holding(subject, c.figure, c.hand, 1 - c.figure, {c.to}));
  }
  return hands;
}

double HandGap(const MetricsContext& subject, const HoldingHand& hand, const NodePositions& node) {
  double gap = std::numeric_limits<double>::max();
  for (const int s : hand.segments) {
    for (const int n : hand.to) {
      gap = std::min(gap, SurfaceGap(subject.body[hand.figure], node[hand.figure], s,
                                     subject.body[hand.to_figure], node[hand.to_figure], n));
    }
  }
  return std::max(gap, 0.0);
}

double HoldingHandGap(const MetricsContext& subject, int figure,
                      const std::vector<NodePositions>& frames) {
  double largest = std::numeric_limits<double>::quiet_NaN();
  if (frames.empty()) return largest;
  for (const HoldingHand& hand : HoldingHands(subject)) {
    if (hand.figure != figure) continue;
    std::vector<double> gaps;
    for (const NodePositions& node : frames) gaps.push_back(HandGap(subject, hand, node));
    const auto at = gaps.begin() +
                    static_cast<long>(std::ceil(kPercentile * static_cast<double>(gaps.size()))) -
                    1;
    std::nth_element(gaps.begin(), at, gaps.end());
    largest = std::fmax(largest, *at);
  }
  return largest;
}

}  // namespace retarget::solver
