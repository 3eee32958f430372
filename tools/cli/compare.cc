// `retarget compare DIR [DIR...]`: finished runs side by side, from their reports.
#include <fmt/format.h>

#include <algorithm>

#include "tools/cli/commands.h"
#include "tools/report/metrics_table.h"

namespace retarget::cli {
namespace {

struct Run {
  std::string folder;
  report::Json report;
};

// Rows of cells; the first column is left-aligned, the others as wide as they need.
class Table {
 public:
  void Add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  std::string Format() const {
    std::vector<size_t> width;
    for (const auto& row : rows_) {
      width.resize(std::max(width.size(), row.size()), 0);
      for (size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], row[c].size());
    }
    std::string out;
    for (const auto& row : rows_) {
      std::string line = fmt::format("{:<{}}", row[0], width[0]);
      for (size_t c = 1; c < row.size(); ++c) line += fmt::format("  {:>{}}", row[c], width[c]);
      out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return out;
  }

 private:
  std::vector<std::vector<std::string>> rows_;
};

std::string Cell(const report::Json& value) {
  if (value.is_number_float()) return fmt::format("{:.4g} ", value.get<double>());
  if (value.is_string()) return value.get<std::string>() + " ";
  return (value.is_null() ? "-" : value.dump()) + " ";
}

// The value under a path of keys, null where there is none.
report::Json At(const report::Json& json, const std::string& pointer) {
  return json.value(report::Json::json_pointer(pointer), report::Json(nullptr));
}

// Weighted or natural cost of a term, null where the report does not say.
report::Json TermCostOf(const Run& run, const std::string& term, const char* key) {
  for (const report::Json& t : run.report.at("solve").at("terms")) {
    if (t.at("term") == term) return t.value(key, report::Json(nullptr));
  }
  return nullptr;
}

std::vector<std::string> TermsOf(const std::vector<Run>& runs) {
  std::vector<std::string> terms;
  for (const Run& run : runs) {
    for (const report::Json& t : run.report.at("solve").at("terms")) {
      const std::string name = t.at("term");
      if (std::find(terms.begin(), terms.end(), name) == terms.end()) terms.push_back(name);
    }
  }
  return terms;
}

// Inputs and configuration that are not the same in all runs: {key: [value per run]}. A file of
// the same content under another name is the same.
report::Json DifferencesOf(const std::vector<Run>& runs) {
  std::vector<report::Json> flat;
  for (const Run& run : runs) {
    report::Json all = {{"inputs", run.report.at("inputs")},
                        {"configuration", run.report.at("configuration")}};
    for (auto& [name, input] : all["inputs"].items()) {
      if (input.is_object()) input.erase("notes");
      const report::Json& first = runs[0].report.at("inputs").value(name, report::Json(nullptr));
      if (!input.is_object() || !input.contains("hash") || !first.is_object()) continue;
      if (input["hash"] == first.value("hash", report::Json(nullptr))) {
        input["file"] = first.value("file", report::Json(nullptr));
      }
    }
    flat.push_back(all.flatten());
  }
  report::Json out = report::Json::object();
  for (const report::Json& keys : flat) {
    for (const auto& [key, unused] : keys.items()) {
      report::Json values = report::Json::array();
      for (const report::Json& f : flat) values.push_back(f.value(key, report::Json(nullptr)));
      const bool same = std::all_of(values.begin(), values.end(),
                                    [&](const report::Json& v) { return v == values.front(); });
      if (same) continue;
      std::string name = key.substr(key.find('/', 1) + 1);
      std::replace(name.begin(), name.end(), '/', '.');
      out[name] = values;
    }
  }
  return out;
}

// A term that makes up no more of the cost had nothing to do.
constexpr double kInactive = 1e-6;

bool HadNothingToDo(const Run& run, const std::string& term) {
  const report::Json cost = TermCostOf(run, term, "cost");
  return cost.is_number() &&
         cost.get<double>() <= kInactive * run.report.at("solve").at("cost").get<double>();
}

// Weights that differ, of terms that had nothing to do in any of the runs: they make no difference.
std::vector<std::string> IdleWeights(const std::vector<Run>& runs,
                                     const report::Json& differences) {
  std::vector<std::string> notes;
  for (const std::string& term : TermsOf(runs)) {
    if (!differences.contains("weights." + term)) continue;
    if (!std::all_of(runs.begin(), runs.end(),
                     [&](const Run& run) { return HadNothingToDo(run, term); })) {
      continue;
    }
    notes.push_back("weights." + term +
                    " had nothing to do: what it asks for is kept in every run at no cost");
  }
  return notes;
}

// What makes the figures of the runs hard to compare, and which differences make none.
std::vector<std::string> NotesOn(const std::vector<Run>& runs, const report::Json& differences) {
  const std::pair<const char*, const char*> kinds[] = {{"clip_a.hash", "clip a"},
                                                       {"clip_b.hash", "clip b"},
                                                       {"template.hash", "template"},
                                                       {"clip_a.start_s", "start of clip a"},
                                                       {"clip_b.start_s", "start of clip b"},
                                                       {"frames.0", "first frame"},
                                                       {"frames.1", "last frame"},
                                                       {"fps", "frame rate"}};
  std::string what;
  for (const auto& [key, name] : kinds) {
    if (differences.contains(key)) what += (what.empty() ? "" : ", ") + std::string(name);
  }
  std::vector<std::string> notes = IdleWeights(runs, differences);
  if (!what.empty()) {
    notes.insert(notes.begin(), "the runs are not of one scene; they differ in: " + what);
  }
  return notes;
}

report::Json ComparisonJson(const std::vector<Run>& runs, const report::Json& differences) {
  report::Json out = {{"runs", report::Json::array()},
                      {"baseline", At(runs[0].report, "/metrics/baseline")},
                      {"differences", differences},
                      {"notes", NotesOn(runs, differences)}};
  for (const Run& run : runs) {
    const report::Json& solve = run.report.at("solve");
    out["runs"].push_back({{"folder", run.folder},
                           {"exit_code", run.report.at("exit_code")},
                           {"requirements_met", run.report.at("requirements_met")},
                           {"metrics", At(run.report, "/metrics/result")},
                           {"requirements", run.report.at("requirements")},
                           {"cost", solve.at("cost")},
                           {"terms", solve.at("terms")},
                           {"status", solve.at("status")},
                           {"iterations", run.report.at("iterations")},
                           {"timings", run.report.at("timings")}});
  }
  return out;
}

// The metrics: the first run's baseline where there is one, then every run's result.
void AddMetrics(const std::vector<Run>& runs, Table* table) {
  struct Column {
    report::Json metrics;
    const report::Json* requirements;
  };
  std::vector<Column> columns;
  std::vector<std::string> header = {""};
  const report::Json baseline = At(runs[0].report, "/metrics/baseline");
  if (!baseline.is_null()) {
    header.push_back("baseline ");
    columns.push_back({baseline, &runs[0].report.at("requirements")});
  }
  for (const Run& run : runs) {
    header.push_back(run.folder + " ");
    columns.push_back({run.report.at("metrics").at("result"), &run.report.at("requirements")});
  }
  table->Add(header);
  for (const report::MetricRow& row : report::MetricRows()) {
    std::vector<std::string> cells = {row.name + (row.unit.empty() ? "" : ", " + row.unit)};
    for (const Column& column : columns) {
      cells.push_back(
          report::MetricCell(row, column.metrics, report::LimitOf(row, *column.requirements)));
    }
    table->Add(cells);
  }
}

void AddSolve(const std::vector<Run>& runs, Table* table) {
  const bool baseline = !At(runs[0].report, "/metrics/baseline").is_null();
  const auto row = [&](const std::string& name, auto value) {
    std::vector<std::string> cells = {name};
    if (baseline) cells.push_back("");
    for (const Run& run : runs) cells.push_back(Cell(value(run)));
    table->Add(cells);
  };
  const std::pair<const char*, const char*> rows[] = {{"requirements met", "/requirements_met"},
                                                      {"status", "/solve/status"},
                                                      {"start, s", "/timings/start_s"},
                                                      {"solve, s", "/timings/solve_s"},
                                                      {"iterations", "/iterations"},
                                                      {"cost", "/solve/cost"}};
  for (const auto& [name, pointer] : rows) {
    row(name, [p = pointer](const Run& run) { return At(run.report, p); });
  }
  for (const auto& [title, key] :
       {std::pair{"cost, ", "cost"}, {"natural cost, ", "natural_cost"}}) {
    for (const std::string& term : TermsOf(runs)) {
      row(title + term, [&, k = key](const Run& run) { return TermCostOf(run, term, k); });
    }
  }
}

std::string ComparisonText(const std::vector<Run>& runs, const report::Json& differences) {
  Table table;
  AddMetrics(runs, &table);
  AddSolve(runs, &table);
  std::string out;
  for (const std::string& note : NotesOn(runs, differences)) out += "note: " + note + "\n";
  out += table.Format();
  if (out.find('*') != std::string::npos) out += report::kStarNote;
  if (runs.size() == 1) return out;
  if (differences.empty()) return out + "inputs and configuration are the same\n";
  Table differing;
  for (const auto& [key, values] : differences.items()) {
    std::vector<std::string> cells = {"  " + key};
    for (const report::Json& value : values) cells.push_back(Cell(value));
    differing.Add(cells);
  }
  return out + "what differs in inputs and configuration:\n" + differing.Format();
}

}  // namespace

int RunCompare(const std::vector<std::string>& folders, bool json) {
  std::vector<Run> runs;
  for (const std::string& folder : folders) runs.push_back({folder, report::ReadReport(folder)});
  // Each report is looked through by itself first, so that a message can name it.
  for (const Run& run : runs) {
    try {
      const report::Json differences = DifferencesOf({run});
      ComparisonJson({run}, differences);
      ComparisonText({run}, differences);
    } catch (const nlohmann::json::exception& error) {
      throw InputError(run.folder + "/report.json: not a report of this program: " + error.what());
    }
  }
  const report::Json differences = DifferencesOf(runs);
  fmt::print("{}", json ? ComparisonJson(runs, differences).dump(1) + "\n"
                        : ComparisonText(runs, differences));
  return kDone;
}

}  // namespace retarget::cli
