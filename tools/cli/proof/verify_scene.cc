// `retarget verify --scene x.glb --template T.yaml`: what any program made, proved against a
// template.
#include <fmt/format.h>

#include <cmath>

#include "io/template_file.h"
#include "tools/cli/commands.h"
#include "tools/proof/foreign_scene.h"
#include "tools/report/requirement_text.h"

namespace retarget::cli {
namespace {

proof::ForeignScene SceneOf(const VerifySceneOptions& options, const TemplatePosture& posture,
                            const TangleSettings& tangle) {
  const std::vector<std::string>& files = options.scene;
  std::array<io::ClipOptions, 2> figures = options.clip;
  const bool mapped = !figures[0].map.empty() && !figures[1].map.empty();
  if (files.size() == 1 && !mapped) {
    if (proof::HasNamedFigures(files[0])) {
      return proof::ReadNamedFigures(files[0], posture, tangle);
    }
    throw InputError(fmt::format(
        "--scene {}: has no nodes \"a/root\" and \"b/root\"; name both figures: --scene "
        "FILE#skin=A --scene FILE#skin=B, or --map-a and --map-b, or two files",
        files[0]));
  }
  for (int f = 0; f < 2; ++f) figures[f].path = files[files.size() == 1 ? 0 : f];
  return proof::ReadFigures(figures, posture, tangle);
}

// "Tag 1 ... 0.823, at least 0.811 for all t, required > 0.5".
std::string StatementLine(const solver::Statement& s) {
  const bool tangle = s.kind == solver::RequirementKind::kTangle;
  const auto shown = [](double value) {
    return std::isnan(value) ? std::string("none") : fmt::format("{:.4g}", value);
  };
  return fmt::format("{:<24}{:>12}{:>14}{:>4}{:>10.4g} {}\n", proof::NameOf(s), shown(s.value),
                     s.proved ? shown(s.bound) : "not proved", tangle ? ">" : "<=", s.limit,
                     report::UnitOf(s.kind));
}

}  // namespace

int RunVerifyScene(const VerifySceneOptions& options, bool json) {
  if (options.template_path.empty()) {
    throw InputError("--template is missing; `verify --scene` proves a scene against a template");
  }
  if (options.scene.size() > 2) throw InputError("--scene: expected one file or two");
  const Settings settings = SettingsOf(options.settings);
  const TemplatePosture posture = io::ReadTemplate(options.template_path);
  const proof::ForeignScene scene = SceneOf(options, posture, settings.tangle);
  PrintNotes(scene.notes, 0);
  const solver::Proof proved = scene.Prove(settings.requirements);
  if (json) {
    report::Json out = proof::ProofJson(proved, scene.subject);
    out["statements"] = proof::StatementsJson(proved);
    out["notes"] = scene.notes;
    fmt::print("{}\n", out.dump(1));
    return proved.proved() ? kDone : kMissed;
  }
  fmt::print("{:<24}{:>12}{:>14}{:>14}\n", "", "worst met", "for all t", "required");
  for (const solver::Statement& s : proved.statements) fmt::print("{}", StatementLine(s));
  fmt::print("{}\n", proof::ProofSentence(proved, scene.subject));
  return proved.proved() ? kDone : kMissed;
}

}  // namespace retarget::cli
