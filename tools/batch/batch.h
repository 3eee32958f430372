// Many pairs, one after the other or side by side, in a folder that can be gone on with
// (docs/batch.md).
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/batch/index.h"
#include "tools/batch/patterns.h"
#include "tools/batch/runner.h"

namespace retarget::batch {

struct BatchRequest {
  std::vector<Pair> pairs;
  std::string out;
  Shard shard;
  bool resume = false;  // leaves alone what is finished and would come to the same
  bool force = false;   // starts over, and replaces folders that no run wrote
  bool pictures = true;
  int processes = 1;
  int64_t memory = 0;  // bytes
};

// "i/n", i from 0. Throws InputError.
Shard ParseShard(const std::string& text);
// That of a task of a Slurm array; the whole batch elsewhere.
Shard ShardOfSlurm();
// "8G", "500M". Throws InputError.
int64_t ParseMemory(const std::string& text);
// Four fifths of what the machine has free.
int64_t FreeMemory();

struct BatchEvents {
  std::function<void(const std::string& line)> tell;  // a line of progress
  std::function<bool()> stop;                         // asked ten times a second
};

struct BatchSummary {
  std::vector<IndexRow> rows;  // of the shard
  bool stopped = false;
  int finished_before = 0;  // of --resume
};

// Runs what is to be run and writes status and, of a whole batch, index.csv and index.html. Throws
// InputError before anything is run.
BatchSummary RunBatch(const BatchRequest& request, const std::vector<Option>& options,
                      const BatchEvents& events);

// The index of all shards in a batch's folder. Throws InputError.
BatchSummary MergeBatch(const std::string& out, const std::optional<std::vector<Pair>>& pairs);

}  // namespace retarget::batch
