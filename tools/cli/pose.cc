// `retarget pose`: the posing session without a page.
#include <fmt/format.h>

#include "io/template_file.h"
#include "tools/cli/commands.h"
#include "tools/posing/command_line.h"
#include "tools/posing/queries.h"
#include "tools/posing/session.h"

namespace retarget::cli {
namespace {

constexpr double kReached = 0.01;  // m, of a drag
constexpr double kStayed = 0.005;  // m, of a pin

TemplatePosture StartOf(const PoseCommandOptions& options) {
  if (!options.template_path.empty()) return io::ReadTemplate(options.template_path);
  if (options.from_clips) return PostureFromClips(*options.from_clips);
  return posing::RestPosture(1.75, 1.75, 1);
}

// One line on what the solver did; empty where it did all that was asked.
std::string ShortfallOf(const solver::PoseResult& result, const TemplatePosture& posture) {
  if (result.drag_error_m <= kReached && result.pin_error_m <= kStayed) return "";
  std::string line = fmt::format("{:.1f} cm from the target, pins {:.1f} mm off",
                                 100 * result.drag_error_m, 1000 * result.pin_error_m);
  if (result.blocked) {
    const auto name = [&](int k) {
      const int f = result.blocked->figure[k];
      return fmt::format("{}/{}", report::kFigure[f],
                         posture.body[f].nodes[result.blocked->node[k]].name);
    };
    line += fmt::format("; {} would go through {}", name(0), name(1));
  } else if (result.stalled) {
    line += "; a limb is in the way";
  } else if (!result.converged) {
    line += "; the iterations ran out";
  }
  return line;
}

// What the solver did in this step, where it was asked.
std::optional<solver::PoseResult> Do(const posing::PoseStep& step, posing::PoseSession* session) {
  if (const auto* history = std::get_if<posing::HistoryStep>(&step)) {
    const bool undo = *history == posing::HistoryStep::kUndo;
    if (!(undo ? session->Undo() : session->Redo())) {
      throw InputError(undo ? "there is nothing to undo" : "there is nothing to redo");
    }
    return std::nullopt;
  }
  return session->Apply(std::get<posing::Operation>(step));
}

void PrintTable(const posing::PoseSession& session) {
  const report::Json q = posing::QueriesJson(session.posture(), nullptr, session.settings());
  fmt::print("{}: {} literal tangles, {} overlaps\n", session.posture().name,
             q["literal_tangles"].get<int>(), q["overlaps"].size());
  for (const report::Json& tag : q["tags"]) {
    fmt::print("tag a ({}, {}) x b ({}, {}): {:+.3f}, {:+.3f} over one half, rho {:.3f}\n",
               tag["a"][0].get<std::string>(), tag["a"][1].get<std::string>(),
               tag["b"][0].get<std::string>(), tag["b"][1].get<std::string>(),
               tag["gli"].get<double>(), tag["to_half"].get<double>(), tag["rho"].get<double>());
  }
  for (const report::Json& warning : q["warnings"]) {
    fmt::print("warning: {}\n", warning.get<std::string>());
  }
}

// Where the nodes are (m), by figure and name: what drags are given against.
report::Json NodesJson(const TemplatePosture& posture) {
  report::Json out;
  const std::array<PosedBody, 2> posed = posing::PosedFigures(posture);
  for (int f = 0; f < 2; ++f) {
    for (int n = 0; n < posture.body[f].num_nodes(); ++n) {
      const Vec3& p = posed[f].node[n];
      out[report::kFigure[f]][posture.body[f].nodes[n].name] = {p.x(), p.y(), p.z()};
    }
  }
  return out;
}

}  // namespace

int RunPose(const PoseCommandOptions& options) {
  posing::PoseSession session(StartOf(options), SettingsOf(options.settings));
  report::Json solves = report::Json::array();
  bool missed = false;
  for (const PoseCommandOptions::Step& step : options.steps) {
    const std::string line =
        "--" + step.name + (step.value.empty() ? std::string() : " " + step.value);
    try {
      const auto result =
          Do(posing::ParsePoseStep(step.name, step.value, session.state()), &session);
      if (!result) continue;
      const std::string shortfall = ShortfallOf(*result, session.posture());
      missed = missed || !shortfall.empty();
      solves.push_back({{"option", line},
                        {"drag_error_m", result->drag_error_m},
                        {"pin_error_m", result->pin_error_m},
                        {"iterations", result->iterations},
                        {"shortfall", shortfall}});
      if (!shortfall.empty()) fmt::print(stderr, "{}: {}\n", line, shortfall);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", line, error.what()));
    }
  }
  if (!options.out.empty()) session.Save(options.out, options.force);
  if (options.json) {
    report::Json out = posing::QueriesJson(session.posture(), nullptr, session.settings());
    out["solves"] = solves;
    out["nodes"] = NodesJson(session.posture());
    fmt::print("{}\n", out.dump(1));
  } else {
    PrintTable(session);
    if (!options.out.empty()) fmt::print("written to {}\n", options.out);
  }
  return missed ? kMissed : kDone;
}

}  // namespace retarget::cli
