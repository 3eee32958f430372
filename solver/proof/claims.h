// What has to be shown, taken apart: every statement is about single pairs of limbs, tags, holds,
// feet, nodes and segments, which are decided one by one. Inner part of solver/proof/proof.h.
#pragma once

#include "solver/proof/proof.h"

namespace retarget::solver {

// Values of all claims are turned so that larger is worse: -distance of a pair's axes against 0,
// depth, -s GLI, distance of held points, drift, depth below the floor, change of a length (%).
enum class ClaimType { kFree, kDepth, kTag, kHold, kFoot, kFloor, kLength };

struct Claim {
  ClaimType type = ClaimType::kFree;
  int statement = 0;
  double limit = 0;
  int item = 0;                // tag, hold, contact of its figure
  int figure = 0;              // of a foot, a floor or a length
  int node_1 = 0, node_2 = 0;  // segments of a pair by outer node; the node of a foot or a floor
};

// A tag's paths, and the pairs of segments that must not meet for its lemma to hold.
struct TagPaths {
  std::vector<int> a, b;    // nodes
  std::vector<char> pairs;  // [pairs] which are of both paths
};

struct Claims {
  std::vector<Statement> statements;
  std::vector<Claim> claims;  // first kFree, then kDepth of all pairs (i - 1) * segments_b + j - 1
  int num_pairs = 0, segments_b = 0;
  std::vector<TagPaths> tags;
  std::array<std::vector<double>, 2> radius;  // the widest capsule at each node (m)
  // Segments whose length cannot change, since nothing that moves lies between their nodes.
  std::array<std::vector<char>, 2> rigid;
  int pass_throughs = 0, penetration = 0;  // statements
};

Claims ClaimsOf(const ProofTask& task);

// The limbs that a finding names.
std::vector<LimbNode> LimbsOf(const ProofTask& task, const Claim& claim);

}  // namespace retarget::solver
