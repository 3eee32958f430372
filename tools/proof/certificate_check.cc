// CheckCertificate of tools/proof/certificate.h.
#include <fmt/format.h>

#include <cmath>

#include "io/settings_file.h"
#include "io/sha256.h"
#include "io/text/read_file.h"
#include "solver/proof/advancement.h"
#include "tools/proof/certificate.h"
#include "tools/report/measured_scene.h"
#include "tools/report/requirement_text.h"
#include "tools/report/subject_json.h"

namespace retarget::proof {
namespace {

using Kind = solver::RequirementKind;

constexpr double kRoundedTo = 1e-6;  // of the numbers in rows

class Checker {
 public:
  explicit Checker(const std::string& folder) : folder_(folder) {}

  CertificateCheck Run() {
    certificate_ = ReadCertificate(folder_);
    try {
      CheckAll();
    } catch (const nlohmann::json::exception& error) {
      throw InputError(folder_ + "/" + kCertificate + ": " + error.what());
    }
    return std::move(out_);
  }

 private:
  void Wrong(const std::string& what) { out_.wrong.push_back(what); }

  void CheckAll() {
    const std::string glb = io::ReadFile(folder_ + "/scene.glb", "the scene of a run");
    if (certificate_.at("scene").at("hash") != io::Sha256Of(glb)) {
      Wrong("scene.glb is not the one that was certified: its hash differs");
    }
    const Json report = report::ReadReport(folder_);
    const solver::MetricsContext subject =
        report::SubjectFromJson(report, folder_ + "/report.json");
    if (certificate_.at("subject_hash") != SubjectHash(subject)) {
      Wrong("bodies, tags, holds or contacts of report.json are not those that were certified");
    }
    const Requirements limits = io::ReadSettings(folder_ + "/config.yaml").requirements;
    const io::SceneMotion scene = io::ParseSceneGlb(glb, folder_ + "/scene.glb");
    const KeyedMotion motion = scene.Keyed();
    const std::array<std::vector<int>, 2> nodes = report::SceneNodes(scene, subject.body);
    const solver::ProofTask task{motion, nodes, subject, limits};
    ReadStatements(task);
    const solver::Advancement found = solver::CheckByAdvancement(task, statements_);
    out_.instants = found.instants;
    const bool proved = certificate_.at("proved");
    if (proved && !certificate_.at("findings").empty()) Wrong("it is proved, and has findings");
    if (proved) {
      for (const solver::AdvancementFailure& failure : found.failures) ReportFailure(failure);
    }
    if (!proved && found.failures.empty()) {
      Wrong("it says that something is not proved, and nothing is lost or undecided");
    }
    CompareRows(found);
  }

  // Each statement with the limit of the run's settings, and none left out.
  void ReadStatements(const solver::ProofTask& task) {
    const Json& listed = certificate_.at("statements");
    for (const solver::Statement& expected : Expected(task)) {
      const std::string name = NameOf(expected);
      const auto at = std::find_if(listed.begin(), listed.end(),
                                   [&](const Json& s) { return s.at("name") == name; });
      statements_.push_back(expected);
      if (at == listed.end()) {
        Wrong(name + ": there is no such statement");
        continue;
      }
      if (at->at("limit") != expected.limit) {
        Wrong(fmt::format("{}: certified against {}, config.yaml requires {}", name,
                          at->at("limit").dump(), expected.limit));
      }
      if (!at->at("bound").is_number()) continue;
      const double bound = at->at("bound");
      const bool kept =
          expected.kind == Kind::kTangle ? bound >= expected.limit : bound <= expected.limit;
      if (!kept) Wrong(fmt::format("{}: its bound {:.4g} is beyond its limit", name, bound));
    }
  }

  // In the order of the certificate's columns.
  static std::vector<solver::Statement> Expected(const solver::ProofTask& task) {
    std::vector<solver::Statement> out;
    const Requirements& limits = task.limits;
    const auto add = [&](Kind kind, double limit, int item = -1, int figure = -1) {
      out.push_back({.kind = kind, .item = item, .figure = figure, .limit = limit});
    };
    const int tags = static_cast<int>(task.subject.tangles.size());
    for (int k = 0; k < tags; ++k) add(Kind::kTangle, limits.gli, k);
    add(Kind::kPassThroughs, limits.pass_throughs);
    add(Kind::kPenetration, limits.penetration_m);
    const int holds = static_cast<int>(task.subject.holds.size());
    for (int k = 0; k < holds; ++k) add(Kind::kHold, limits.hold_m, k);
    for (int f = 0; f < 2; ++f) {
      add(Kind::kFootDrift, limits.foot_drift_m, -1, f);
      add(Kind::kFloor, limits.floor_m, -1, f);
      add(Kind::kSegmentLength, limits.segment_length_percent, -1, f);
    }
    return out;
  }

  void ReportFailure(const solver::AdvancementFailure& failure) {
    const solver::Statement statement{
        .kind = failure.kind, .item = failure.item, .figure = failure.figure};
    Wrong(fmt::format("{}: not confirmed at {:.4f} s, where it is {:.4g}", NameOf(statement),
                      failure.time_s, failure.value));
  }

  // No row claims more than what is met in its interval.
  void CompareRows(const solver::Advancement& found) {
    const Json& intervals = certificate_.at("intervals");
    const Json& rows = intervals.at("rows");
    if (rows.size() != found.worst.size()) {
      Wrong(fmt::format("it has {} intervals, the scene {}", rows.size(), found.worst.size()));
      return;
    }
    const size_t first = intervals.at("columns").size() - statements_.size();
    for (size_t k = 0; k < rows.size(); ++k) {
      if (rows[k].size() != first + statements_.size()) {
        Wrong(fmt::format("interval {} has not one bound per statement", k));
        return;
      }
      for (size_t s = 0; s < statements_.size(); ++s) {
        if (!rows[k][first + s].is_number()) continue;
        const double bound = rows[k][first + s], worst = found.worst[k][s];
        const bool tangle = statements_[s].kind == Kind::kTangle;
        if (tangle ? worst >= bound - kRoundedTo : worst <= bound + kRoundedTo) continue;
        Wrong(fmt::format("{}: interval {} claims {:.6g}, {:.6g} is met there",
                          NameOf(statements_[s]), k, bound, worst));
        return;
      }
    }
  }

  const std::string folder_;
  Json certificate_;
  std::vector<solver::Statement> statements_;
  CertificateCheck out_;
};

}  // namespace

CertificateCheck CheckCertificate(const std::string& folder) { return Checker(folder).Run(); }

}  // namespace retarget::proof
