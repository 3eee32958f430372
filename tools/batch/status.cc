#include "tools/batch/status.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>

#include "io/files.h"
#include "io/text/read_file.h"
#include "tools/report/json_reading.h"
#include "tools/report/metrics_table.h"
#include "tools/report/requirement_json.h"

namespace retarget::batch {
namespace {

namespace fs = std::filesystem;
using report::Json;

std::string Now() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

Json TextOrNull(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

void ReadMetrics(const Json& report, Record* record) {
  const Json& result = report::At(report, "/metrics/result");
  for (const report::MetricRow& row : report::MetricRows()) {
    const double value = row.value(result);
    const std::string label = LabelOf(row);
    record->metrics[label] = std::isfinite(value) ? Json(value) : Json(nullptr);
    const Json limit = report::LimitOf(row, report.at("requirements"));
    if (!limit.is_null()) record->limits[label] = limit;
  }
}

void ReadResult(const std::string& folder, Record* record) {
  const Json report = report::ReadReport(folder);
  for (const report::ReadRequirement& requirement : report::RequirementsOf(report)) {
    if (!requirement.met && record->missed.empty()) record->missed = requirement.name;
  }
  record->frames = report.value("frames", record->frames);
  record->peak_bytes = static_cast<int64_t>(report::NumberAt(report, "/memory/peak_bytes"));
  ReadMetrics(report, record);
}

Record RecordFrom(const Json& json) {
  Record record;
  record.id = json.at("id");
  record.hash = json.at("hash");
  record.exit_code = json.at("exit_code");
  record.missed = report::TextAt(json, "/missed");
  record.error = report::TextAt(json, "/error");
  record.ended = json.at("ended");
  record.seconds = json.at("seconds");
  record.frames = json.at("frames");
  record.peak_bytes = json.at("peak_bytes");
  record.metrics = json.at("metrics");
  record.limits = json.at("limits");
  return record;
}

}  // namespace

Json JsonOf(const Record& record) {
  return {{"id", record.id},
          {"exit_code", record.exit_code},
          {"missed", TextOrNull(record.missed)},
          {"error", TextOrNull(record.error)},
          {"seconds", std::round(1000 * record.seconds) / 1000},
          {"frames", record.frames},
          {"peak_bytes", record.peak_bytes},
          {"metrics", record.metrics},
          {"limits", record.limits},
          {"hash", record.hash},
          {"ended", record.ended}};
}

Record RecordOf(const Job& job, int exit_code, const std::string& message, double seconds,
                const std::string& folder) {
  Record record;
  record.id = job.pair.id;
  record.hash = job.hash;
  record.exit_code = exit_code;
  record.ended = Now();
  record.seconds = seconds;
  record.frames = job.frames;
  if (record.HasResult()) {
    try {
      ReadResult(folder, &record);
      return record;
    } catch (const std::exception& error) {
      record.exit_code = 1;
      record.error = error.what();
      return record;
    }
  }
  record.error = message.empty() ? fmt::format("ended with code {}", exit_code) : message;
  if (exit_code > 128) {  // by a signal
    record.error = fmt::format("ended by signal {}", exit_code - 128);
    record.exit_code = 1;
  }
  return record;
}

std::string StatusName(const Shard& shard) {
  return shard.whole() ? "status.jsonl"
                       : fmt::format("status.{}-of-{}.jsonl", shard.index, shard.count);
}

std::map<std::string, Record> ReadRecords(const std::string& folder) {
  std::map<std::string, Record> records;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename();
    if (!name.starts_with("status.") || !name.ends_with(".jsonl")) continue;
    const std::string text = io::TryReadFile(entry.path().string()).value_or("");
    for (size_t at = 0; at < text.size();) {
      const size_t end = std::min(text.find('\n', at), text.size());
      const Json json = Json::parse(text.begin() + static_cast<long>(at),
                                    text.begin() + static_cast<long>(end), nullptr, false);
      at = end + 1;
      try {
        Record record = RecordFrom(json);
        Record& known = records[record.id];
        if (known.ended <= record.ended) known = std::move(record);
      } catch (const nlohmann::json::exception&) {
        continue;
      }
    }
  }
  std::erase_if(records, [](const auto& item) { return item.second.id.empty(); });
  return records;
}

void AppendRecord(const std::string& path, const Record& record) {
  const std::string line = JsonOf(record).dump() + "\n";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "ab"),
                                                             &std::fclose);
  if (file) std::setvbuf(file.get(), nullptr, _IOFBF, line.size() + 1);  // one write
  if (!file || std::fwrite(line.data(), 1, line.size(), file.get()) != line.size() ||
      std::fflush(file.get()) != 0) {
    throw InputError(path + ": cannot be written");
  }
}

void WriteRecords(const std::string& path, const std::map<std::string, Record>& records,
                  const std::vector<std::string>& ids) {
  std::string text;
  for (const std::string& id : ids) {
    const auto record = records.find(id);
    if (record != records.end()) text += JsonOf(record->second).dump() + "\n";
  }
  io::WriteFile(path, text, true);
}

}  // namespace retarget::batch
