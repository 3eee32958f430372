// `retarget tangles`, `retarget template`: what is tangled in a posture, making and checking
// templates.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/files.h"
#include "io/settings_file.h"
#include "io/template_file.h"
#include "io/text/read_file.h"
#include "model/body/path.h"
#include "solver/metrics/metrics.h"
#include "solver/start/fit_template.h"
#include "tools/api/clip_posture.h"
#include "tools/api/template_check.h"
#include "tools/cli/commands.h"
#include "tools/report/requirement_json.h"
#include "tools/report/requirement_text.h"

namespace retarget::cli {
namespace {

// Node positions as JSON, {"A": [[x, y, z] x 21], "B": ...}.
std::array<std::vector<Vec3>, 2> PositionsFromJson(const report::Json& json,
                                                   const std::string& path, size_t nodes) {
  std::array<std::vector<Vec3>, 2> out;
  for (int f = 0; f < 2; ++f) {
    const char* key = f == 0 ? "A" : "B";
    if (!json.is_object() || !json.contains(key)) {
      throw InputError(
          fmt::format("{}: expected {{\"A\": [[x, y, z] x {}], \"B\": ...}}, found no \"{}\"", path,
                      nodes, key));
    }
    const report::Json& list = json.at(key);
    if (!list.is_array() || list.size() != nodes) {
      throw InputError(fmt::format("{}: \"{}\": expected {} node positions", path, key, nodes));
    }
    for (const report::Json& p : list) {
      const bool good =
          p.is_array() && p.size() == 3 &&
          std::all_of(p.begin(), p.end(), [](const report::Json& x) { return x.is_number(); });
      if (!good)
        throw InputError(fmt::format("{}: \"{}\": expected positions [x, y, z]", path, key));
      out[f].emplace_back(p[0], p[1], p[2]);
      if (!out[f].back().allFinite())
        throw InputError(fmt::format("{}: \"{}\": a position is not finite", path, key));
    }
  }
  return out;
}

struct Found {
  std::array<Body, 2> body;
  solver::TemplateTangles tangles;
  std::vector<HandContact> contacts;
};

void PrintContacts(const std::array<Body, 2>& body, const std::vector<HandContact>& contacts) {
  for (const HandContact& c : contacts) {
    const int g = 1 - c.figure;
    fmt::print("contact {} {} ({:.2f}) on {} {} ({:.2f})\n", report::kFigure[c.figure],
               body[c.figure].nodes[c.hand].name, c.along, report::kFigure[g],
               body[g].nodes[c.to].name, c.to_along);
  }
}

Found FindIn(const std::string& path, const Settings& all) {
  const TangleSettings& settings = all.tangle;
  const std::string text = io::ReadFile(path);
  const size_t first = text.find_first_not_of(" \t\r\n");
  Found found;
  if (first == std::string::npos || text[first] != '{') {
    const TemplatePosture posture = io::ParseTemplate(text, path);
    found.body = posture.body;
    found.tangles = solver::FindTemplateTangles(posture, settings);
    found.contacts = HandContactsOf(posture, all.hand_contact.reach_m);
    return found;
  }
  report::Json json;
  try {
    json = report::Json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(path + ": " + error.what());
  }
  const Body body = StandardBody(AverageMeasures(1.75));
  found.body = {body, body};
  const std::array<std::vector<Vec3>, 2> nodes = PositionsFromJson(json, path, body.nodes.size());
  const PosedBody a = PosedFromNodes(body, nodes[0]), b = PosedFromNodes(body, nodes[1]);
  const MatX table = SegmentGliTable(body, nodes[0], body, nodes[1]);
  found.tangles.literal = FindTangles(body, body, table);
  found.tangles.tags =
      ReduceTangles(body, a, body, b, found.tangles.literal, table, solver::ReductionOf(settings));
  found.contacts = FindHandContacts(found.body, {a, b}, all.hand_contact.reach_m);
  return found;
}

}  // namespace

int RunTangles(const std::string& path, const SettingsOptions& settings, bool json) {
  const Found found = FindIn(path, SettingsOf(settings));
  const Body &a = found.body[0], &b = found.body[1];
  if (json) {
    report::Json out = {{"literal", report::Json::array()}, {"tags", report::Json::array()}};
    for (const Tangle& t : found.tangles.literal)
      out["literal"].push_back(api::TangleJson(a, b, t));
    for (const Tag& tag : found.tangles.tags) {
      report::Json entry = api::TangleJson(a, b, tag.tangle);
      entry["rho"] = tag.rho;
      entry["group_size"] = tag.group_size;
      out["tags"].push_back(entry);
    }
    out["contacts"] = api::ContactsJson(found.body, found.contacts);
    fmt::print("{}\n", out.dump(1));
    return kDone;
  }
  fmt::print("{} literal tangles (Algorithm 1)\n", found.tangles.literal.size());
  for (const Tangle& t : found.tangles.literal) {
    fmt::print("  {:<64} {:+.4f}\n", TangleText(a, b, t), t.gli);
  }
  fmt::print("{} tags\n", found.tangles.tags.size());
  for (const Tag& tag : found.tangles.tags) {
    fmt::print("  {:<64} {:+.4f}  rho {:.3f}  stands for {}\n", TangleText(a, b, tag.tangle),
               tag.tangle.gli, tag.rho, tag.group_size);
  }
  PrintContacts(found.body, found.contacts);
  return kDone;
}

int RunTemplateCheck(const std::string& path, const SettingsOptions& settings, bool json) {
  const TemplatePosture posture = io::ReadTemplate(path);
  const api::TemplateCheck check = api::CheckTemplate(posture, SettingsOf(settings));
  const solver::TemplateTangles& tangles = check.tangles;
  const solver::Metrics& metrics = check.metrics;
  const std::vector<solver::RequirementCheck>& checks = check.checks;
  const std::vector<std::string>& warnings = check.warnings;
  const std::array<Body, 2>& bodies = posture.body;
  const std::vector<HandContact> contacts =
      HandContactsOf(posture, SettingsOf(settings).hand_contact.reach_m);
  const bool met = check.met();
  if (json) {
    report::Json out = {{"name", posture.name},
                        {"requirements_met", met},
                        {"requirements", report::ChecksJson(checks, bodies)},
                        {"tags", report::Json::array()},
                        {"warnings", warnings}};
    for (const Tag& tag : tangles.tags) {
      out["tags"].push_back(api::TangleJson(bodies[0], bodies[1], tag.tangle));
      out["tags"].back()["rho"] = tag.rho;
    }
    out["contacts"] = api::ContactsJson(bodies, contacts);
    fmt::print("{}\n", out.dump(1));
    return met ? kDone : kMissed;
  }
  fmt::print("{}: {}\n", path, posture.name);
  for (int f = 0; f < 2; ++f) {
    const Body& body = posture.body[f];
    fmt::print(
        "{}: stature {:.2f} m, {} nodes, {} joints; feet {:.1f} cm below the floor, "
        "self-penetration {:.1f} cm\n",
        f == 0 ? "a" : "b", body.stature, body.num_nodes(), body.num_links() - 1,
        100 * metrics.figure[f].floor_m, 100 * metrics.figure[f].self_penetration_m);
  }
  for (const Tag& tag : tangles.tags) {
    fmt::print("tag {}: {:+.3f}, rho {:.3f}\n", TangleText(bodies[0], bodies[1], tag.tangle),
               tag.tangle.gli, tag.rho);
  }
  PrintContacts(bodies, contacts);
  for (const auto& figure : metrics.figure) {
    if (std::isnan(figure.holding_hand_gap_m)) continue;
    fmt::print("holding hands of {}: {:.1f} cm off what they hold\n",
               report::kFigure[&figure - metrics.figure.data()], 100 * figure.holding_hand_gap_m);
  }
  for (size_t k = 0; k < metrics.hold_m.size(); ++k) {
    fmt::print("hold {}: {:.1f} cm\n", k + 1, 100 * metrics.hold_m[k]);
  }
  fmt::print("penetration: {:.1f} cm\n", 100 * metrics.penetration_m);
  for (const std::string& warning : warnings) fmt::print("warning: {}\n", warning);
  for (const solver::RequirementCheck& c : checks) {
    if (!c.met)
      fmt::print("MISSED {}: {:.4g} {}, required {:.4g} {}\n", report::NameOf(c), c.value,
                 report::UnitOf(c.kind), c.limit, report::WorstPlace(c, bodies));
  }
  return met ? kDone : kMissed;
}

TemplatePosture PostureFromClips(const FromClipsOptions& options) {
  const io::LoadedClip a = io::LoadClip(options.clip[0]), b = io::LoadClip(options.clip[1]);
  TemplatePosture posture;
  try {
    posture = api::PostureOfFrames({&a, &b}, {options.frame, options.frame}, true);
  } catch (const InputError& error) {
    throw InputError(std::string("--") + error.what());
  }
  posture.name = options.name;
  posture.description = fmt::format("frame {} of {} and {}", options.frame, options.clip[0].path,
                                    options.clip[1].path);
  return posture;
}

int RunTemplateFromClips(const FromClipsOptions& options) {
  const TemplatePosture posture = PostureFromClips(options);
  const std::string text = io::FormatTemplate(posture);
  io::ParseTemplate(text, options.out);  // what is written can be read
  io::WriteFile(options.out, text, options.force);
  fmt::print("written to {}\n", options.out);
  return kDone;
}

}  // namespace retarget::cli
