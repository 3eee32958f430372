#include "tools/batch/batch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <set>

#include "io/files.h"
#include "io/text/read_file.h"
#include "tools/batch/lock.h"

namespace retarget::batch {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kFramesOfProcess = 60;  // what a process costs beside its frames, in frames

std::string PathIn(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

std::string Duration(double seconds) {
  const long s = std::lround(seconds);
  if (s < 100) return fmt::format("{} s", s);
  if (s < 6000) return fmt::format("{} min", (s + 30) / 60);
  return fmt::format("{:.1f} h", static_cast<double>(s) / 3600);
}

// Lines of progress: what ended how, how fast it goes, when it will be over.
class Progress {
 public:
  Progress(const std::vector<Job>& jobs, const BatchEvents& events)
      : events_(events), count_(jobs.size()), begin_(Clock::now()) {
    for (const Job& job : jobs) left_ += job.frames + kFramesOfProcess;
  }

  void Finished(const Record& record, int planned_frames) {
    const double cost = planned_frames + kFramesOfProcess;
    left_ -= cost;
    done_ += cost;
    ++ended_;
    missed_ += record.exit_code != 0;
    const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    const double wait = seconds * left_ / done_;
    const std::time_t end = std::time(nullptr) + std::lround(wait);
    char clock[16] = "";
    std::strftime(clock, sizeof clock, "%H:%M", std::localtime(&end));
    events_.tell(
        fmt::format("{:>{}}/{} {}  {}  {:.1f} s{} | {:.1f} pairs/min, ends {} (in {}){}", ended_,
                    fmt::formatted_size("{}", count_), count_, record.id, OutcomeOf(record),
                    record.seconds, record.error.empty() ? "" : ": " + record.error,
                    60 * static_cast<double>(ended_) / std::max(seconds, 1e-3), clock,
                    Duration(wait), missed_ == 0 ? "" : fmt::format(", {} not met", missed_)));
  }

 private:
  const BatchEvents& events_;
  size_t count_, ended_ = 0;
  int missed_ = 0;
  double left_ = 0, done_ = 0;
  Clock::time_point begin_;
};

bool IsFinished(const Job& job, const std::map<std::string, Record>& records,
                const std::string& out) {
  const auto record = records.find(job.pair.id);
  if (record == records.end() || record->second.hash != job.hash || !record->second.IsFinal()) {
    return false;
  }
  return !record->second.HasResult() || fs::exists(fs::path(out) / job.pair.id / "report.json");
}

void CheckFolder(const BatchRequest& request) {
  std::error_code error;
  fs::create_directories(request.out, error);
  if (!fs::is_directory(request.out)) {
    throw InputError(fmt::format("--out {}: cannot be created", request.out));
  }
  if (access(request.out.c_str(), W_OK) != 0) {
    throw InputError(fmt::format("--out {}: cannot be written to", request.out));
  }
  if (request.resume || request.force) return;
  if (fs::exists(PathIn(request.out, StatusName(request.shard)), error)) {
    throw InputError(
        fmt::format("--out {}: has pairs of an earlier batch; give --resume to go on, "
                    "--force to start over, or choose another folder",
                    request.out));
  }
}

void WriteIndex(const std::string& out, const std::vector<IndexRow>& rows) {
  io::WriteFile(PathIn(out, "index.csv"), FormatIndexCsv(rows), true);
  io::WriteFile(PathIn(out, "index.html"), FormatIndexPage(rows), true);
}

std::vector<std::string> IdsOf(const std::vector<Pair>& pairs) {
  std::vector<std::string> ids;
  for (const Pair& pair : pairs) ids.push_back(pair.id);
  return ids;
}

std::vector<IndexRow> RowsOf(const std::vector<Pair>& pairs,
                             const std::map<std::string, Record>& records) {
  std::vector<IndexRow> rows;
  for (const Pair& pair : pairs) {
    const auto record = records.find(pair.id);
    rows.push_back({pair, record == records.end() ? std::nullopt : std::optional(record->second)});
  }
  return rows;
}

int NumberIn(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  if (text == nullptr) return otherwise;
  int number = otherwise;
  const std::string_view view(text);
  std::from_chars(view.data(), view.data() + view.size(), number);
  return number;
}

}  // namespace

Shard ParseShard(const std::string& text) {
  Shard shard;
  int read = 0;
  const bool parsed = std::sscanf(text.c_str(), "%d/%d%n", &shard.index, &shard.count, &read) == 2;
  if (!parsed || read != static_cast<int>(text.size()) || shard.index < 0 ||
      shard.index >= shard.count) {
    throw InputError(fmt::format("--shard {}: expected i/n with 0 <= i < n", text));
  }
  return shard;
}

Shard ShardOfSlurm() {
  const int count = NumberIn("SLURM_ARRAY_TASK_COUNT", 1);
  const int step = std::max(1, NumberIn("SLURM_ARRAY_TASK_STEP", 1));
  const int index =
      (NumberIn("SLURM_ARRAY_TASK_ID", 0) - NumberIn("SLURM_ARRAY_TASK_MIN", 0)) / step;
  if (count <= 1) return {};
  if (index < 0 || index >= count) {
    throw InputError(fmt::format(
        "the tasks of the Slurm array are not in equal steps (task {} of {}); give --shard", index,
        count));
  }
  return {index, count};
}

int64_t ParseMemory(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const std::string unit = end;
  const double factor = unit == "G" ? 1e9 : unit == "M" ? 1e6 : 0;
  if (end == text.c_str() || factor == 0 || !(number > 0) || number > 1e6) {
    throw InputError(fmt::format("--memory {}: expected a number with G or M, such as 8G", text));
  }
  return static_cast<int64_t>(number * factor);
}

int64_t FreeMemory() {
  const std::string text = io::TryReadFile("/proc/meminfo").value_or("");
  const size_t at = text.find("MemAvailable:");
  const long kilobytes = at == std::string::npos ? 4'000'000 : std::atol(text.c_str() + at + 13);
  return int64_t{kilobytes} * 1024 / 5 * 4;
}

BatchSummary RunBatch(const BatchRequest& request, const std::vector<Option>& options,
                      const BatchEvents& events) {
  CheckFolder(request);
  const ShardLock lock(PathIn(request.out, ".lock-" + StatusName(request.shard)));
  const std::vector<Job> planned = PlanJobs(request.pairs, request.shard);
  std::map<std::string, Record> records;
  if (request.resume) records = ReadRecords(request.out);
  const std::vector<std::string> all_ids = IdsOf(request.pairs);
  const std::set<std::string> known(all_ids.begin(), all_ids.end());
  const auto forgotten =
      std::erase_if(records, [&](const auto& r) { return !known.count(r.first); });
  if (forgotten > 0) {
    events.tell(
        fmt::format("note: {} pairs of an earlier manifest are no longer in it; their "
                    "folders stay, the index leaves them out",
                    forgotten));
  }

  std::vector<Job> jobs;
  std::vector<Pair> own;
  std::map<std::string, int> frames;
  for (const Job& job : planned) {
    own.push_back(job.pair);
    if (IsFinished(job, records, request.out)) continue;
    records.erase(job.pair.id);
    frames[job.pair.id] = job.frames;
    jobs.push_back(job);
  }
  const std::vector<std::string> ids = IdsOf(own);
  const std::string status = PathIn(request.out, StatusName(request.shard));
  io::WriteFile(PathIn(request.out, "manifest.jsonl"), FormatPairs(request.pairs), true);
  WriteRecords(status, records, ids);

  const RunnerOptions runner{request.out,    status,           ids,          request.processes,
                             request.memory, request.pictures, request.force};
  BatchSummary summary;
  summary.finished_before = static_cast<int>(planned.size() - jobs.size());
  events.tell(
      fmt::format("{} pairs{}{}, {} at once, at most {:.1f} GB", jobs.size(),
                  request.shard.whole()
                      ? ""
                      : fmt::format(" of shard {}/{}", request.shard.index, request.shard.count),
                  summary.finished_before == 0
                      ? ""
                      : fmt::format(" ({} more are finished already)", summary.finished_before),
                  std::min<size_t>(static_cast<size_t>(request.processes), jobs.size()),
                  static_cast<double>(MostMemory(jobs, runner)) / 1e9));
  Progress progress(jobs, events);
  summary.stopped = !RunJobs(
      jobs, options, runner,
      [&](const Record& record) {
        records[record.id] = record;
        progress.Finished(record, frames.at(record.id));
      },
      events.stop);

  WriteRecords(status, records, ids);
  summary.rows = RowsOf(own, records);
  if (request.shard.whole()) WriteIndex(request.out, summary.rows);
  return summary;
}

BatchSummary MergeBatch(const std::string& out, const std::optional<std::vector<Pair>>& pairs) {
  const std::vector<Pair> all = pairs ? *pairs : ReadPairs(out);
  const std::map<std::string, Record> records = ReadRecords(out);
  WriteRecords(PathIn(out, "status.jsonl"), records, IdsOf(all));
  BatchSummary summary;
  summary.rows = RowsOf(all, records);
  WriteIndex(out, summary.rows);
  return summary;
}

}  // namespace retarget::batch
