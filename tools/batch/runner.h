// The pairs of a batch, each in a process of its own: a crash costs one pair, and memory goes back.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tools/batch/plan.h"
#include "tools/batch/status.h"

namespace retarget::batch {

struct RunnerOptions {
  std::string out;               // folder of the batch, which exists
  std::string status;            // path of the status file that is added to
  std::vector<std::string> ids;  // of the whole shard: what an earlier process left of them goes
  int processes = 1;             // at once, fewer where memory does not allow them
  int64_t memory = 0;    // bytes that all of them may take together; a larger pair runs alone
  bool pictures = true;  // scene.png in the folder of each
  bool force = false;    // folders that no run wrote may be replaced
};

// The most memory that the processes will take together at any time, by the estimates.
int64_t MostMemory(const std::vector<Job>& jobs, const RunnerOptions& options);

// Runs the jobs, those with the most frames first. Of each that ended, its line is added to the
// status file and then its folder appears under `out`, whole; `finished` is called, one call at a
// time. `stop` is asked ten times a second: once it says true, running processes are killed, and
// nothing is left of their pairs. Returns whether all were run.
bool RunJobs(std::vector<Job> jobs, const std::vector<Option>& options, const RunnerOptions& runner,
             const std::function<void(const Record&)>& finished, const std::function<bool()>& stop);

}  // namespace retarget::batch
