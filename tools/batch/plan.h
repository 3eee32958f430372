// What each pair of a batch will cost, and what it depends on, known before it runs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/batch/manifest.h"

namespace retarget::batch {

struct Job {
  Pair pair;
  size_t index = 0;  // of the pair in the whole batch
  // SHA-256 of the program's version, the contents of all files that are read, the effective
  // settings and the options: equal hashes give equal results.
  std::string hash;
  int frames = 0;     // output frames; 0: the clips cannot be read
  int64_t bytes = 0;  // most memory that its process will take, estimated from the frames
};

// A part of a batch: pairs whose index is `index` modulo `count`.
struct Shard {
  int index = 0, count = 1;
  bool whole() const { return count == 1; }
};

// Reads the clips. What cannot be read is no error here: the run of the pair will say so.
std::vector<Job> PlanJobs(const std::vector<Pair>& pairs, const Shard& shard);

// The command line of a job but for --out.
std::vector<std::string> ArgumentsOf(const Pair& pair, const std::vector<Option>& options);

}  // namespace retarget::batch
