#include "tools/posing/queries.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/body/joint_limit.h"
#include "model/body/path.h"
#include "model/body/shape.h"
#include "model/geometry/capsule.h"
#include "solver/start/weak_tags.h"
#include "tools/api/template_check.h"
#include "tools/posing/state.h"
#include "tools/report/requirement_json.h"
#include "tools/report/requirement_text.h"

namespace retarget::posing {
namespace {

constexpr double kDeep = 0.01;           // m: overlaps worth a warning
constexpr double kBeyond = 1 * kDegree;  // of a joint's limit, the same

void AddOverlap(const TemplatePosture& posture, const std::array<PosedBody, 2>& posed,
                const solver::LimbPair& limbs, std::vector<LimbOverlap>* overlaps) {
  std::array<Vec3, 2> start, end;
  std::array<double, 2> radius;
  for (int k = 0; k < 2; ++k) {
    const Body& body = posture.body[limbs.figure[k]];
    const std::vector<Vec3>& node = posed[limbs.figure[k]].node;
    start[k] = node[body.nodes[limbs.node[k]].parent];
    end[k] = node[limbs.node[k]];
    radius[k] = body.nodes[limbs.node[k]].radius;
  }
  const ClosestPoints closest = ClosestPointsOfSegments(start[0], end[0], start[1], end[1]);
  const double depth = CapsuleDepth(closest, radius[0], radius[1]);
  if (depth <= 0) return;
  const Vec3 p = start[0] + closest.s * (end[0] - start[0]);
  // The normal points from the second to the first.
  overlaps->push_back({limbs, depth, p - (radius[0] - 0.5 * depth) * closest.normal});
}

std::string LimbName(const TemplatePosture& posture, const solver::LimbPair& limbs, int k) {
  return fmt::format("{}/{}", report::kFigure[limbs.figure[k]],
                     posture.body[limbs.figure[k]].nodes[limbs.node[k]].name);
}

bool IsRequested(const TemplatePosture& posture, const Tag& tag) {
  return std::any_of(posture.tangles.begin(), posture.tangles.end(), [&](const TangleRequest& t) {
    return t.a == tag.tangle.a && t.b == tag.tangle.b;
  });
}

// Those that are to be kept: those that the posture lists, else all.
std::vector<Tag> KeptTags(const TemplatePosture& posture, const std::vector<Tag>& tags) {
  std::vector<Tag> kept;
  for (const Tag& tag : tags) {
    if (posture.tangles.empty() || IsRequested(posture, tag)) kept.push_back(tag);
  }
  return kept;
}

// Also what is found beside a posture's own list.
std::vector<Tag> AllTags(const TemplatePosture& posture, const std::vector<Tag>& kept,
                         const TangleSettings& settings) {
  if (posture.tangles.empty()) return kept;
  TemplatePosture unlisted = posture;
  unlisted.tangles.clear();
  std::vector<Tag> all = kept;
  for (const Tag& tag : solver::FindTemplateTangles(unlisted, settings).tags) {
    if (!IsRequested(posture, tag)) all.push_back(tag);
  }
  return all;
}

report::Json TagsJson(const TemplatePosture& posture, const std::vector<Tag>& tags) {
  report::Json out = report::Json::array();
  for (const Tag& tag : tags) {
    report::Json entry = api::TangleJson(posture.body[0], posture.body[1], tag.tangle);
    entry["to_half"] = std::abs(tag.tangle.gli) - kTangleThreshold;
    entry["rho"] = tag.rho;
    entry["group_size"] = tag.group_size;
    entry["requested"] = IsRequested(posture, tag);
    entry["weak"] = solver::IsWeak(tag);
    entry["can_slip"] = solver::IsEasilyLost(tag);
    out.push_back(entry);
  }
  return out;
}

report::Json OverlapsJson(const TemplatePosture& posture,
                          const std::vector<LimbOverlap>& overlaps) {
  report::Json out = report::Json::array();
  for (const LimbOverlap& o : overlaps) {
    out.push_back({{"limbs", {LimbName(posture, o.limbs, 0), LimbName(posture, o.limbs, 1)}},
                   {"depth_m", o.depth},
                   {"place", {o.place.x(), o.place.y(), o.place.z()}}});
  }
  return out;
}

report::Json TableJson(const MatX& table) {
  report::Json out = report::Json::array();
  for (long i = 0; i < table.rows(); ++i) {
    report::Json row = report::Json::array();
    for (long j = 0; j < table.cols(); ++j) row.push_back(std::round(1e4 * table(i, j)) / 1e4);
    out.push_back(row);
  }
  return out;
}

// Joints beyond a limit: how far (degrees).
report::Json LimitsJson(const TemplatePosture& posture) {
  report::Json out = report::Json::object();
  for (int f = 0; f < 2; ++f) {
    for (int l = 1; l < posture.body[f].num_links(); ++l) {
      const std::vector<double> beyond = BeyondLimits(posture, f, l);
      const double most = *std::max_element(beyond.begin(), beyond.end());
      if (most > kBeyond) {
        out[fmt::format("{}/{}", report::kFigure[f], posture.body[f].links[l].name)] =
            most / kDegree;
      }
    }
  }
  return out;
}

void AddOverlapWarnings(const TemplatePosture& posture, const std::vector<LimbOverlap>& overlaps,
                        std::vector<std::string>* warnings) {
  for (const LimbOverlap& o : overlaps) {
    if (o.depth < kDeep) continue;
    warnings->push_back(fmt::format("{} and {} overlap by {:.1f} cm at ({:.2f}, {:.2f}, {:.2f})",
                                    LimbName(posture, o.limbs, 0), LimbName(posture, o.limbs, 1),
                                    100 * o.depth, o.place.x(), o.place.y(), o.place.z()));
  }
}

std::vector<std::string> Warnings(const TemplatePosture& posture, const api::TemplateCheck& check,
                                  const std::vector<LimbOverlap>& overlaps) {
  std::vector<std::string> warnings = check.warnings;
  for (const solver::RequirementCheck& c : check.checks) {
    if (c.met) continue;
    warnings.push_back(fmt::format("{}: {:.4g} {}, required {:.4g}", report::NameOf(c), c.value,
                                   report::UnitOf(c.kind), c.limit));
  }
  AddOverlapWarnings(posture, overlaps, &warnings);
  return warnings;
}

}  // namespace

std::vector<LimbOverlap> OverlapsOf(const TemplatePosture& posture) {
  const std::array<PosedBody, 2> posed = PosedFigures(posture);
  std::vector<LimbOverlap> overlaps;
  for (int i = 1; i < posture.body[0].num_nodes(); ++i) {
    for (int j = 1; j < posture.body[1].num_nodes(); ++j) {
      AddOverlap(posture, posed, {{0, 1}, {i, j}}, &overlaps);
    }
  }
  for (int f = 0; f < 2; ++f) {
    for (const auto& [i, j] : SelfPairs(posture.body[f])) {
      AddOverlap(posture, posed, {{f, f}, {i, j}}, &overlaps);
    }
  }
  std::stable_sort(overlaps.begin(), overlaps.end(),
                   [](const LimbOverlap& x, const LimbOverlap& y) { return x.depth > y.depth; });
  return overlaps;
}

MatX GliTableOf(const TemplatePosture& posture) {
  const std::array<PosedBody, 2> posed = PosedFigures(posture);
  return SegmentGliTable(posture.body[0], posed[0].node, posture.body[1], posed[1].node).cwiseAbs();
}

std::vector<double> BeyondLimits(const TemplatePosture& posture, int figure, int link) {
  std::vector<double> beyond;
  for (const LimitExcess& e : LimitExcesses(posture.body[figure], link, posture.pose[figure])) {
    beyond.push_back(e.beyond);
  }
  return beyond;
}

std::vector<std::string> WarningsOf(const TemplatePosture& posture, const Settings& settings) {
  return Warnings(posture, api::CheckTemplate(posture, settings), OverlapsOf(posture));
}

std::vector<Tag> Remeasured(const std::vector<Tag>& tags, const TemplatePosture& posture) {
  const std::array<PosedBody, 2> posed = PosedFigures(posture);
  const Body &a = posture.body[0], &b = posture.body[1];
  std::vector<Tag> out = tags;
  for (Tag& tag : out) {
    Tangle& tangle = tag.tangle;
    tangle.gli = GliOfPaths(a, posed[0].node, tangle.a, b, posed[1].node, tangle.b);
    const double norm = TangleGradientNorm(a, posed[0], b, posed[1], tangle);
    tag.rho = (std::abs(tangle.gli) - kTangleThreshold) / std::max(norm, 1e-12);
  }
  return out;
}

report::Json LiveQueriesJson(const TemplatePosture& posture, const std::vector<Tag>& tags) {
  const std::vector<Tag> now = Remeasured(tags, posture);
  const std::vector<LimbOverlap> overlaps = OverlapsOf(posture);
  std::vector<std::string> warnings = api::TagWarnings(posture, KeptTags(posture, now));
  AddOverlapWarnings(posture, overlaps, &warnings);
  return {{"tags", TagsJson(posture, now)},
          {"overlaps", OverlapsJson(posture, overlaps)},
          {"warnings", warnings}};
}

report::Json QueriesJson(const TemplatePosture& posture, std::vector<Tag>* tags,
                         const Settings& settings) {
  const api::TemplateCheck check = api::CheckTemplate(posture, settings);
  const std::vector<Tag> all = AllTags(posture, check.tangles.tags, settings.tangle);
  if (tags) *tags = all;
  const std::vector<LimbOverlap> overlaps = OverlapsOf(posture);
  return {{"name", posture.name},
          {"requirements_met", check.met()},
          {"requirements", report::ChecksJson(check.checks, posture.body)},
          {"tags", TagsJson(posture, all)},
          {"literal_tangles", check.tangles.literal.size()},
          {"overlaps", OverlapsJson(posture, overlaps)},
          {"beyond_limits_deg", LimitsJson(posture)},
          {"warnings", Warnings(posture, check, overlaps)},
          {"gli_table", TableJson(GliTableOf(posture))}};
}

}  // namespace retarget::posing
