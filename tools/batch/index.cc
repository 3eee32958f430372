#include "tools/batch/index.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/text/csv.h"
#include "io/text/read_file.h"
#include "tools/batch/index_script.h"
#include "tools/batch/sweep_plots.h"
#include "tools/report/embedded_page.h"
#include "tools/report/html.h"
#include "tools/report/metrics_table.h"

namespace retarget::batch {
namespace {

using report::EscapeHtml;
using report::Json;

// Of all pairs, in the order in which they first appear.
std::vector<std::string> ColumnsOf(const std::vector<IndexRow>& rows, bool swept) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const IndexRow& row : rows) {
    if (swept) {
      for (const std::string& name : row.pair.swept) add(name);
    } else {
      for (const auto& [name, value] : row.pair.columns) add(name);
    }
  }
  return names;
}

// For an address: all but letters, digits and what is plain there.
std::string Address(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool plain = isalnum(static_cast<unsigned char>(c)) ||
                       std::string("-._~@=+,").find(c) != std::string::npos;
    out += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

std::string CellHtml(const report::MetricRow& row, const Record& record) {
  const std::string label = LabelOf(row);
  const double value = NumberIn(record.metrics, label), limit = NumberIn(record.limits, label);
  if (std::isnan(value)) return "<td class=\"number\" data-v=\"\">–</td>";
  const bool bad = std::isfinite(limit) && report::Misses(row, value, limit);
  return fmt::format("<td class=\"number{}\" data-v=\"{}\">{:.2f}</td>", bad ? " bad" : "", value,
                     value);
}

std::string RowHtml(const IndexRow& row, const std::vector<std::string>& swept) {
  const bool has_result = row.record && row.record->HasResult();
  const bool met = row.record && row.record->exit_code == 0;
  const std::string folder = Address(row.pair.id), name = EscapeHtml(row.pair.id);
  std::string html = fmt::format("<tr{}>", met ? "" : " class=\"missed\"");
  if (has_result) {
    html += fmt::format(
        "<td><a href=\"{0}/{2}\"><img src=\"{0}/scene.png\" loading=\"lazy\" alt=\"\"></a></td>"
        "<td><a href=\"{0}/{2}\">{1}</a> <small><a href=\"{0}/scene.glb\">glb</a></small></td>",
        folder, name, row.pair.Column("no-page") == "true" ? "report.json" : "report.html");
  } else {
    html += fmt::format("<td></td><td>{}</td>", name);
  }
  const std::string error = row.record ? row.record->error : "";
  html +=
      fmt::format("<td class=\"{}\" title=\"{}\">{}{}</td>", met ? "met" : "bad", EscapeHtml(error),
                  EscapeHtml(OutcomeOf(row.record)), error.empty() ? "" : ": " + EscapeHtml(error));
  for (const std::string& column : swept) {
    html += fmt::format("<td class=\"number\">{}</td>", EscapeHtml(row.pair.Column(column)));
  }
  for (const report::MetricRow& metric : report::MetricRows()) {
    html += row.record ? CellHtml(metric, *row.record) : "<td></td>";
  }
  return html + "</tr>\n";
}

std::string TableHtml(const std::vector<IndexRow>& rows, const std::vector<std::string>& swept) {
  std::string html = "<div class=\"scroll\"><table id=\"pairs\">\n<thead><tr><th></th>";
  const auto head = [&](const std::string& name, const std::string& unit) {
    html += fmt::format("<th><button>{}<br><small>{}</small></button></th>", EscapeHtml(name),
                        EscapeHtml(unit));
  };
  head("pair", "");
  head("outcome", "");
  for (const std::string& column : swept) head(column, "");
  for (const report::MetricRow& row : report::MetricRows()) head(row.name, row.unit);
  html += "</tr></thead>\n<tbody>\n";
  for (const IndexRow& row : rows) html += RowHtml(row, swept);
  return html + "</tbody></table></div>\n";
}

std::string CountsText(const std::vector<IndexRow>& rows) {
  int met = 0, missed = 0, without = 0, left = 0;
  for (const IndexRow& row : rows) {
    if (!row.record) {
      ++left;
    } else if (!row.record->HasResult()) {
      ++without;
    } else {
      ++(row.record->exit_code == 0 ? met : missed);
    }
  }
  std::string text =
      fmt::format("{} pairs: {} meet every requirement, {} do not", rows.size(), met, missed);
  if (without > 0) text += fmt::format(", {} have no result", without);
  if (left > 0) text += fmt::format(", {} are not run yet", left);
  return text;
}

}  // namespace

std::string OutcomeOf(const std::optional<Record>& record) {
  if (!record) return "not run";
  if (!record->HasResult()) return "no result";
  if (record->exit_code == 4) return "limit hit";
  return record->exit_code == 0 ? "met" : record->missed + " missed";
}

std::string FormatIndexCsv(const std::vector<IndexRow>& rows) {
  const std::vector<std::string> columns = ColumnsOf(rows, false);
  std::string csv = "id,exit_code,missed,error";
  for (std::string column : columns) {
    if (column.find('.') == std::string::npos) std::replace(column.begin(), column.end(), '-', '_');
    csv += "," + io::CsvCell(column);
  }
  for (const report::MetricRow& row : report::MetricRows()) csv += "," + io::CsvCell(LabelOf(row));
  csv += ",hash\n";
  for (const IndexRow& row : rows) {
    const Record none, &record = row.record ? *row.record : none;
    csv += io::CsvCell(row.pair.id) + "," +
           (row.record ? std::to_string(record.exit_code) : std::string()) + "," +
           io::CsvCell(record.missed) + "," + io::CsvCell(record.error);
    for (const std::string& column : columns) csv += "," + io::CsvCell(row.pair.Column(column));
    for (const report::MetricRow& metric : report::MetricRows()) {
      const double value = NumberIn(record.metrics, LabelOf(metric));
      csv += std::isnan(value) ? std::string(",") : fmt::format(",{}", value);
    }
    csv += "," + record.hash + "\n";
  }
  return csv;
}

std::string FormatIndexPage(const std::vector<IndexRow>& rows) {
  const std::vector<std::string> swept = ColumnsOf(rows, true);
  std::string html =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>Batch</title>\n<style>";
  html += report::EmbeddedThemeCss();
  html += kIndexStyle;
  html += fmt::format(
      "</style>\n</head>\n<body>\n<h1>Batch</h1>\n<p>{}. <a href=\"index.csv\">index.csv</a> · "
      "<a href=\"status.jsonl\">status.jsonl</a></p>\n",
      CountsText(rows));
  for (const std::string& column : swept) html += SweepHtml(rows, column);
  html +=
      "<h2>Pairs</h2>\n<p><label><input type=\"checkbox\" id=\"missed\"> only what does not "
      "meet every requirement</label></p>\n";
  html += TableHtml(rows, swept);
  return html + kIndexScript + "</body>\n</html>\n";
}

std::string FormatPairs(const std::vector<Pair>& pairs) {
  std::string text;
  for (const Pair& pair : pairs) {
    Json columns = Json::object();
    for (const auto& [name, value] : pair.columns) columns[name] = value;
    text +=
        Json({{"id", pair.id}, {"row", pair.row_id}, {"swept", pair.swept}, {"columns", columns}})
            .dump() +
        "\n";
  }
  return text;
}

std::vector<Pair> ReadPairs(const std::string& folder) {
  const std::string path = (std::filesystem::path(folder) / "manifest.jsonl").string();
  const std::string text = io::ReadFilledFile(path, "the folder of a batch");
  std::vector<Pair> pairs;
  try {
    for (size_t at = 0; at < text.size();) {
      const size_t end = std::min(text.find('\n', at), text.size());
      const Json json = Json::parse(text.substr(at, end - at));
      at = end + 1;
      Pair pair{json.at("id"), json.at("row"), path, {}, json.at("swept")};
      for (const auto& [name, value] : json.at("columns").items()) {
        pair.columns.emplace_back(name, value);
      }
      pairs.push_back(std::move(pair));
    }
  } catch (const nlohmann::json::exception& error) {
    throw InputError(path + ": not written by this program: " + error.what());
  }
  return pairs;
}

}  // namespace retarget::batch
