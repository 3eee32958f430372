#include "tools/report/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/report/comparison_tables.h"
#include "tools/report/html.h"
#include "tools/report/json_reading.h"
#include "tools/report/requirement_json.h"
#include "tools/report/verdict.h"

namespace retarget::report {
namespace {

std::string Card(const std::string& title, const std::string& body, const std::string& note = "",
                 bool wide = false) {
  if (body.empty()) return "";
  return fmt::format("<section class=\"card{}\"><h2>{}</h2>{}{}</section>\n", wide ? " wide" : "",
                     title, note.empty() ? "" : "<p>" + note + "</p>", body);
}

std::string RequirementsHtml(const Json& report) {
  HtmlTable table(
      {{"requirement"}, {""}, {"value", "number"}, {"limit", "number"}, {"worst place"}});
  for (const ReadRequirement& r : RequirementsOf(report)) {
    const double scale = r.unit == "m" ? 100 : 1;
    const std::string shown = r.unit == "m" ? " cm" : r.unit.rfind('%', 0) == 0 ? " %" : "";
    const int digits = r.unit.empty() ? 0 : 2;
    table.Row({{EscapeHtml(r.name)},
               std::isnan(r.value) ? Cell{"nothing to judge"}
               : r.met             ? Cell{"✓ met", "good"}
                                   : Cell{"✕ missed", "bad"},
               {Decimal(scale * r.value, digits) + shown, "number"},
               {Decimal(scale * r.limit, digits) + shown, "number unit"},
               {WithFrame(Humanize(r.where), r.frame)}},
              r.met ? "" : "class=\"missed\"");
  }
  return table.empty() ? "" : table.Html();
}

std::string TermsHtml(const Json& report) {
  std::vector<Json> terms;
  double sum = 0;
  for (const Json& term : At(report, "/solve/terms")) {
    terms.push_back(term);
    sum += std::max(0.0, NumberAt(term, "/cost"));
  }
  std::stable_sort(terms.begin(), terms.end(), [](const Json& x, const Json& y) {
    return NumberAt(x, "/cost") > NumberAt(y, "/cost");
  });
  HtmlTable table({{"term"},
                   {"weighted cost", "number"},
                   {"share", "number"},
                   {"natural cost", "number"},
                   {"largest residual", "number"},
                   {"unit"},
                   {"weight", "number"},
                   {"to change it"}});
  for (const Json& term : terms) {
    const std::string name = term.value("term", "");
    const double cost = NumberAt(term, "/cost"), weight = NumberAt(term, "/weight");
    const double natural = NumberAt(term, "/natural_cost");
    const auto precise = [](double v) {
      return std::isnan(v) ? std::string("–") : fmt::format("{:.3g}", v);
    };
    table.Row({{EscapeHtml(Humanize(name))},
               {precise(cost), "number"},
               {sum > 0 ? Decimal(100 * cost / sum, 1) + " %" : "–", "number"},
               {precise(natural), "number"},
               {precise(NumberAt(term, "/largest")), "number"},
               {EscapeHtml(term.value("unit", "")), "unit"},
               {precise(weight), "number"},
               {fmt::format("<code>--set weights.{}={:.4g}</code>", EscapeHtml(name), weight)}});
  }
  return table.empty() ? "" : table.Html();
}

std::string ListHtml(const Json& sentences) {
  std::string out;
  for (const Json& item : sentences) {
    if (item.is_string()) out += "<li>" + EscapeHtml(item.get<std::string>()) + "</li>";
  }
  return out.empty() ? "" : "<ul>" + out + "</ul>";
}

std::string ConflictsHtml(const Json& report) {
  std::string out;
  for (const Sentence& sentence : VerdictOf(report).why) {
    out += "<li>" + WithFrame(sentence.text, sentence.frame) + "</li>";
  }
  return out.empty() ? "" : "<ul>" + out + "</ul>";
}

std::string InputsHtml(const Json& report) {
  HtmlTable table({{""}, {"file"}, {"recognised as"}, {"start", "number"}, {"fingerprint"}});
  std::string notes;
  for (const auto& [key, label] :
       {std::pair("clip_a", "a"), {"clip_b", "b"}, {"template", "hold"}}) {
    const std::string at = std::string("/inputs/") + key;
    const std::string profile = TextAt(report, at + "/profile");
    const double unit = NumberAt(report, at + "/units"), start = NumberAt(report, at + "/start_s");
    const double instant = NumberAt(report, at + "/at_s");
    table.Row({{label},
               {EscapeHtml(TextAt(report, at + "/file"))},
               {profile.empty() ? ""
                                : fmt::format("{}, {:.4g} m per unit, {} up", EscapeHtml(profile),
                                              unit, EscapeHtml(TextAt(report, at + "/up")))},
               {Decimal(std::isnan(start) ? instant : start, 2) + " s", "number"},
               {"<code>" + EscapeHtml(TextAt(report, at + "/hash")) + "</code>"}});
    notes += ListHtml(At(report, at + "/notes"));
  }
  return table.Html() + notes;
}

std::string PairsHtml(const std::vector<std::pair<std::string, std::string>>& pairs) {
  HtmlTable table({});
  for (const auto& [name, value] : pairs) {
    if (!value.empty()) table.Row({{EscapeHtml(name)}, {EscapeHtml(value)}});
  }
  return table.empty() ? "" : table.Html();
}

std::string StartHtml(const Json& report) {
  const auto number = [&](const char* pointer, int digits, const char* unit) {
    const double value = NumberAt(report, pointer);
    return std::isnan(value) ? "" : Decimal(value, digits) + unit;
  };
  const std::string simulation =
      PairsHtml({{"simulation", Humanize(TextAt(report, "/simulation/status"))},
                 {"", TextAt(report, "/simulation/message")},
                 {"settled for", number("/simulation/settle_s", 2, " s")},
                 {"left to settle", number("/simulation/settle_distance_m", 3, " m")},
                 {"took", number("/simulation/seconds", 2, " s")},
                 {"speed", number("/simulation/realtime_factor", 1, " x real time")},
                 {"frames simulated", number("/simulation/frames_simulated", 0, "")},
                 {"start asked for", TextAt(report, "/start/requested")},
                 {"start used", TextAt(report, "/start/used")},
                 {"because", TextAt(report, "/start/reason")},
                 {"final cost from the simulated start", number("/start/costs/simulated", 2, "")},
                 {"final cost from the template start", number("/start/costs/template", 2, "")}});
  return simulation.empty() ? "<p>No simulation in this run.</p>" : simulation;
}

std::string SolveHtml(const Json& report) {
  std::vector<std::pair<std::string, std::string>> pairs = {
      {"back end", TextAt(report, "/solve/backend")}, {"status", TextAt(report, "/solve/status")}};
  const auto add = [&](const std::string& name, const std::string& pointer, int digits,
                       const char* unit, double scale = 1) {
    const double value = scale * NumberAt(report, pointer);
    if (!std::isnan(value)) pairs.emplace_back(name, Decimal(value, digits) + unit);
  };
  add("cost at the start", "/solve/initial_cost", 2, "");
  add("cost at the end", "/solve/cost", 2, "");
  add("iterations", "/solve/iterations", 0, "");
  add("linear solves", "/solve/linear_solves", 0, "");
  for (const auto& [key, value] : At(report, "/timings").items()) {
    const bool seconds = key.size() > 2 && key.compare(key.size() - 2, 2, "_s") == 0;
    if (key == "frames_per_s") {
      add("speed of the solve", "/timings/" + key, 0, " frames/s");
    } else {
      add("time, " + Humanize(seconds ? key.substr(0, key.size() - 2) : key), "/timings/" + key, 2,
          " s");
    }
  }
  add("memory at most", "/memory/peak_bytes", 0, " MB", 1e-6);
  for (const auto& [key, value] : At(report, "/versions").items()) {
    pairs.emplace_back(key, value.is_string() ? value.get<std::string>() : value.dump());
  }
  return PairsHtml(pairs);
}

std::string SettingsHtml(const Json& report) {
  std::string rows;
  for (const auto& [key, value] : At(report, "/configuration").items()) {
    rows += fmt::format("<div><code>{}</code><span>{}</span></div>", EscapeHtml(key),
                        EscapeHtml(value.is_string() ? value.get<std::string>() : value.dump()));
  }
  if (rows.empty()) return "";
  return "<section class=\"card wide\"><details><summary>Configuration</summary>"
         "<div class=\"settings\">" +
         rows + "</div></details></section>\n";
}

// A term and its sentences, at most `most`; then how many more there are.
std::string Definition(const std::string& term, const std::vector<Sentence>& sentences, size_t most,
                       const char* kind = "") {
  if (sentences.empty()) return "";
  std::string out = "<dt>" + term + "</dt>";
  for (size_t k = 0; k < std::min(most, sentences.size()); ++k) {
    out += fmt::format("<dd class=\"{}\">{}</dd>", kind,
                       WithFrame(sentences[k].text, sentences[k].frame));
  }
  if (sentences.size() > most) {
    out += fmt::format("<dd class=\"more\">and {} more, under Requirements</dd>",
                       sentences.size() - most);
  }
  return out + "\n";
}

}  // namespace

std::string VerdictHtml(const Json& report) {
  constexpr size_t kAll = 100;
  const Verdict verdict = VerdictOf(report);
  std::vector<Sentence> asked = verdict.asked;
  for (size_t k = 2; k < asked.size(); ++k) asked[1].text += " " + asked[k].text;  // in one line
  asked.resize(std::min<size_t>(2, asked.size()));
  std::vector<Sentence> proof;
  if (const std::string text = TextAt(report, "/proof/sentence"); !text.empty()) {
    proof.push_back({text});
  }
  const std::string left =
      Definition("Asked", asked, kAll) + Definition("Between frames", proof, 1) +
      Definition("Missed", verdict.missed, 3, "bad") + Definition("Stopped", verdict.stopped, kAll);
  const std::string right =
      Definition("Compared", verdict.compared, kAll) + Definition("Look at", verdict.look, kAll);
  return fmt::format(
      "<header class=\"{}\"><p class=\"run\">{}</p><h1>{}</h1>\n<div "
      "class=\"sentences\"><dl>{}</dl>"
      "<dl>{}</dl></div></header>\n",
      verdict.met ? "met" : "missed", EscapeHtml(report.value("generator", "retarget")),
      EscapeHtml(verdict.outcome), left, right);
}

std::string TablesHtml(const Json& report) {
  std::string out = "<div class=\"cards\">\n";
  out += Card("Tags", TagsTableHtml(report),
              "A tag is a pair of paths along the limbs that must stay wound round each other. "
              "s GLI says how far they are, in turns: above one half they are tangled.",
              true);
  out += Card("Why requirements are missed", ConflictsHtml(report), "", true);
  out += "<div class=\"column\">" + Card("Requirements", RequirementsHtml(report)) +
         Card("Holds", HoldsTableHtml(report)) +
         Card("Warnings", ListHtml(At(report, "/warnings"))) + "</div>\n";
  out += "<div class=\"column\">" + Card("Metrics", MetricsTableHtml(report)) + "</div>\n";
  out +=
      Card("Terms of the objective", TermsHtml(report),
           "Cost = ½ Σ (weight · residual)²; the natural cost is the same without weights. Where "
           "something gives way too far, raise its weight or lower that of what it gives way to.",
           true);
  out += Card("Inputs", InputsHtml(report), "", true);
  out += Card("Simulation and start", StartHtml(report));
  out += Card("Solve and timings", SolveHtml(report));
  out += SettingsHtml(report);
  return out +
         "</div>\n<footer>Metrics are measured on the written GLB files. s GLI: Gauss Linking "
         "Integral times the template's sign.</footer>\n";
}

}  // namespace retarget::report
