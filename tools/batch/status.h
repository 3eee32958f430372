// What became of each pair: a line of JSON each in status.jsonl, or, of a shard, in
// status.I-of-N.jsonl.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/batch/plan.h"
#include "tools/report/report.h"

namespace retarget::batch {

struct Record {
  std::string id, hash;
  int exit_code = 1;   // of the contract; 1 also where its process was killed
  std::string missed;  // the first requirement that is missed
  std::string error;   // why there is no result
  std::string ended;   // UTC, ISO 8601
  double seconds = 0;  // from the start of its process to its end
  int frames = 0;
  int64_t peak_bytes = 0;
  report::Json metrics = report::Json::object();  // {label of a metric row: value or null}
  report::Json limits = report::Json::object();   // {the same: what is required}

  bool HasResult() const { return exit_code == 0 || exit_code == 3 || exit_code == 4; }
  // Whether to run it again would come to the same.
  bool IsFinal() const { return HasResult() || exit_code == 2; }
};

report::Json JsonOf(const Record& record);

// What the process of a job left: its exit code, what it said last, and report.json in `folder`.
Record RecordOf(const Job& job, int exit_code, const std::string& message, double seconds,
                const std::string& folder);

// "status.jsonl", "status.2-of-8.jsonl".
std::string StatusName(const Shard& shard);

// The newest record of every id in all status files of a batch's folder. Lines that are no records
// (a machine that went down while it wrote) are left out.
std::map<std::string, Record> ReadRecords(const std::string& folder);

// Adds a line to a status file, at once.
void AppendRecord(const std::string& path, const Record& record);

// The whole file anew: those of `records` that `ids` names, in that order.
void WriteRecords(const std::string& path, const std::map<std::string, Record>& records,
                  const std::vector<std::string>& ids);

}  // namespace retarget::batch
