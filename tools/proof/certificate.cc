#include "tools/proof/certificate.h"

#include <fmt/format.h>

#include <cmath>

#include "io/sha256.h"
#include "io/text/read_file.h"
#include "solver/proof/gap_bound.h"
#include "solver/proof/gli_bound.h"
#include "tools/report/requirement_json.h"
#include "tools/report/requirement_text.h"
#include "tools/report/subject_json.h"

namespace retarget::proof {
namespace {

using Kind = solver::RequirementKind;

Json NumberOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

// Away from what is claimed, so that rounding claims nothing.
std::string Outward(double bound, Kind kind) {
  if (!std::isfinite(bound)) return "null";
  const double grain = 1e6;
  const double rounded =
      kind == Kind::kTangle ? std::floor(bound * grain) / grain : std::ceil(bound * grain) / grain;
  return fmt::format("{:.6g}", rounded);
}

Json StatementsJson(const solver::Proof& proof) {
  Json out = Json::array();
  for (const solver::Statement& s : proof.statements) {
    Json one = {{"name", NameOf(s)}};
    solver::RequirementCheck check{.kind = s.kind, .item = s.item, .figure = s.figure};
    report::AddPlace(check, &one);
    one.erase("frame");
    one["unit"] = report::UnitOf(s.kind);
    one["limit"] = s.limit;
    one["proved"] = s.proved;
    one["bound"] = s.proved ? NumberOrNull(s.bound) : Json(nullptr);
    one["value"] = s.value;
    out.push_back(one);
  }
  return out;
}

Json TopologyJson(const solver::Proof& proof, const solver::MetricsContext& subject, double begin,
                  double end) {
  Json tags = Json::array();
  double crossings = 0;
  for (const solver::Statement& s : proof.statements) {
    if (s.kind == Kind::kPassThroughs) crossings = s.value;
    if (s.kind != Kind::kTangle) continue;
    const solver::TangleTarget& held = subject.tangles[s.item];
    const Tangle& t = held.tag.tangle;
    const auto path = [&](int f, const Path& p) -> Json {
      return {subject.body[f].nodes[p.from].name, subject.body[f].nodes[p.to].name};
    };
    tags.push_back({{"a", path(0, t.a)},
                    {"b", path(1, t.b)},
                    {"sign", held.sign},
                    {"from_s", begin},
                    {"to_s", end},
                    {"kept", s.proved}});
  }
  return {{"crossings", crossings}, {"tags", tags}};
}

// One row per key interval, one line each.
std::string RowsText(const solver::Proof& proof) {
  std::string out = "[";
  for (size_t k = 0; k < proof.intervals.size(); ++k) {
    const solver::IntervalProof& interval = proof.intervals[k];
    out += fmt::format("{}\n   [{},{}", k > 0 ? "," : "", interval.depth, interval.evaluations);
    for (size_t s = 0; s < proof.statements.size(); ++s) {
      out += "," + Outward(interval.bound[s], proof.statements[s].kind);
    }
    out += "]";
  }
  return out + "\n  ]";
}

}  // namespace

std::string SubjectHash(const solver::MetricsContext& subject) {
  solver::Metrics none;  // SubjectJson shows values beside what they are about
  none.tangles.resize(subject.tangles.size());
  none.hold_m.resize(subject.holds.size());
  none.hold_frame.resize(subject.holds.size());
  Json json = report::SubjectJson(subject, none);
  // What a report that is read back knows again.
  Json about;
  for (const char* key : {"tangles", "holds", "contacts", "bodies"}) about[key] = json[key];
  for (Json& tangle : about["tangles"]) tangle.erase("rho");
  for (Json& hold : about["holds"]) hold.erase("rotation");
  return io::Sha256Of(about.dump());
}

std::string FormatCertificate(const solver::Proof& proof, const solver::MetricsContext& subject,
                              const std::string& scene_glb, const std::string& generator) {
  const io::SceneMotion scene = io::ParseSceneGlb(scene_glb, "scene.glb");
  const std::vector<double>& keys = scene.key_times;
  Json columns = {"depth", "stretches"};
  for (const solver::Statement& s : proof.statements) columns.push_back(NameOf(s));
  const Json out = {{"format", 1},
                    {"generator", generator},
                    {"summary", ProofSentence(proof, subject)},
                    {"proved", proof.proved()},
                    {"scene", {{"file", "scene.glb"}, {"hash", io::Sha256Of(scene_glb)}}},
                    {"subject_hash", SubjectHash(subject)},
                    {"motion",
                     {{"keys", keys.size()},
                      {"from_s", keys.front()},
                      {"to_s", keys.back()},
                      {"translation", "linear"},
                      {"rotation", "spherical-linear, the shorter arc"}}},
                    {"tolerances",
                     {{"length_m", solver::kLengthMargin},
                      {"gli_turns", solver::kGliMargin},
                      {"smallest_stretch", solver::kSmallestStretch}}},
                    {"statements", StatementsJson(proof)},
                    {"topology", TopologyJson(proof, subject, keys.front(), keys.back())},
                    {"findings", FindingsJson(proof, subject)},
                    {"stretches", proof.evaluations},
                    {"depth", proof.depth},
                    {"intervals", {{"columns", columns}, {"rows", "@"}}}};
  std::string text = out.dump(1) + "\n";
  const std::string mark = "\"@\"";
  text.replace(text.rfind(mark), mark.size(), RowsText(proof));
  return text;
}

Json ReadCertificate(const std::string& folder) {
  const std::string path = folder + "/" + kCertificate;
  const std::string text = io::ReadFile(path, "the certificate of a run");
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded() || !json.is_object() || json.value("format", Json()) != Json(1)) {
    throw InputError(path + ": not a certificate of this program, format 1");
  }
  return json;
}

}  // namespace retarget::proof
