// `retarget batch`: the pairs of a manifest.
#include "tools/batch/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <thread>

#include "io/text/read_file.h"
#include "tools/cli/commands.h"

namespace retarget::cli {
namespace {

volatile std::sig_atomic_t batch_stopped = 0;

// What the batch itself decides for every pair.
constexpr const char* kNoColumns[] = {"help", "version", "out", "force", "json", "progress", "set"};

std::vector<batch::Option> ColumnsOf(const std::vector<OptionSpec>& options) {
  std::vector<batch::Option> columns;
  for (const OptionSpec& option : options) {
    for (const std::string& name : option.names) {
      if (!name.starts_with("--")) continue;
      const std::string column = name.substr(2);
      if (std::find(std::begin(kNoColumns), std::end(kNoColumns), column) == std::end(kNoColumns)) {
        columns.push_back({column, option.value.empty()});
      }
    }
  }
  return columns;
}

std::string PatternManifest(const BatchOptions& options) {
  if (options.templates.empty()) throw InputError("--pairs: --template is missing");
  return batch::ManifestOfPatterns(
      options.pairs[0], options.pairs[1], options.templates,
      options.pairing == "name" ? batch::Pairing::kName : batch::Pairing::kAll);
}

batch::BatchRequest RequestOf(const BatchOptions& options, std::vector<batch::Pair> pairs) {
  batch::BatchRequest request;
  request.pairs = std::move(pairs);
  request.out = options.out;
  request.shard = options.shard.empty() ? batch::ShardOfSlurm() : batch::ParseShard(options.shard);
  request.resume = options.resume;
  request.force = options.force;
  request.pictures = options.pictures;
  request.processes = options.processes > 0
                          ? options.processes
                          : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  request.memory =
      options.memory.empty() ? batch::FreeMemory() : batch::ParseMemory(options.memory);
  return request;
}

std::string SummaryText(const batch::BatchSummary& summary, const std::string& out) {
  size_t met = 0;
  std::string list;
  for (const batch::IndexRow& row : summary.rows) {
    if (row.record && row.record->exit_code == 0) {
      ++met;
      continue;
    }
    list += fmt::format("  {}  {}{}\n", row.pair.id, batch::OutcomeOf(row.record),
                        row.record && !row.record->error.empty() ? ": " + row.record->error : "");
  }
  return fmt::format("{}{} of {} pairs meet every requirement; written to {}\n", list, met,
                     summary.rows.size(), out);
}

std::string SummaryJson(const batch::BatchSummary& summary, const std::string& out) {
  report::Json json = {
      {"out", out}, {"stopped", summary.stopped}, {"pairs", report::Json::array()}};
  for (const batch::IndexRow& row : summary.rows) {
    json["pairs"].push_back(row.record
                                ? batch::JsonOf(*row.record)
                                : report::Json({{"id", row.pair.id}, {"exit_code", nullptr}}));
  }
  return json.dump(1) + "\n";
}

int CodeOf(const batch::BatchSummary& summary) {
  if (summary.stopped) return kInterrupted;
  return std::all_of(summary.rows.begin(), summary.rows.end(),
                     [](const batch::IndexRow& row) {
                       return row.record && row.record->exit_code == kDone;
                     })
             ? kDone
             : kMissed;
}

}  // namespace

int RunBatch(const BatchOptions& options, const std::vector<OptionSpec>& program) {
  const std::vector<batch::Option> columns = ColumnsOf(program);
  const bool patterns = !options.pairs[0].empty();
  std::optional<std::vector<batch::Pair>> pairs;
  if (patterns) {
    const std::string manifest = PatternManifest(options);
    if (options.out.empty()) {
      fmt::print("{}", manifest);
      return kDone;
    }
    pairs = batch::ParseManifest(manifest, "--pairs", "", columns, options.with);
  } else if (!options.manifest.empty()) {
    pairs = batch::ReadManifest(options.manifest, columns, options.with);
  } else if (!options.merge) {
    throw InputError("batch: name a manifest, or give --pairs and --template");
  }
  if (options.out.empty()) throw InputError("batch: --out is missing");

  batch::BatchSummary summary;
  if (options.merge) {
    summary = batch::MergeBatch(options.out, pairs);
  } else {
    for (const int signal : {SIGINT, SIGTERM}) {
      std::signal(signal, [](int) { batch_stopped = 1; });
    }
    summary = batch::RunBatch(RequestOf(options, std::move(*pairs)), columns,
                              {[](const std::string& line) { fmt::print(stderr, "{}\n", line); },
                               [] { return batch_stopped != 0; }});
  }
  fmt::print("{}",
             options.json ? SummaryJson(summary, options.out) : SummaryText(summary, options.out));
  if (summary.stopped) {
    fmt::print(stderr, "stopped; the same command with --resume goes on\n");
  }
  return CodeOf(summary);
}

}  // namespace retarget::cli
