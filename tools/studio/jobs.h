// Solves that are tried from the page: `retarget` itself as a child process in a temporary folder,
// so that neither a crash nor a stop takes the studio with it.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tools/report/report.h"
#include "tools/studio/child_process.h"

namespace retarget::studio {

struct SolveRequest {
  std::string template_name;           // what the report calls it
  std::string template_text;           // YAML
  std::vector<std::string> arguments;  // beside --template, --out and --progress
};

// All methods throw StudioError: 404 for an unknown job, 409 where one is running already.
class StudioJobs {
 public:
  StudioJobs() = default;
  ~StudioJobs();  // ends what runs, removes what it wrote

  std::string Start(const SolveRequest& request);
  // Lets it finish its iteration and write the best so far; ends it at once where there is nothing
  // yet, and when it is asked a second time.
  void Stop(const std::string& job);

  // Events from the `cursor`-th on as a text of server-sent events; waits up to a second for the
  // first. False: there will be no more.
  bool NextEvents(const std::string& job, size_t* cursor, std::string* text);
  bool Knows(const std::string& job);

  // Bytes of a file that a run wrote.
  std::string File(const std::string& job, const std::string& name);
  // Ends what runs; to be called before the program ends.
  void Close();

 private:
  struct Job {
    std::filesystem::path folder;
    std::unique_ptr<ChildProcess> child;
    std::vector<std::string> events;  // as they are sent
    std::string last_line;
    int log_lines = 0;
    bool iterates = false, stopped = false, over = false;
    std::thread reader;
  };

  std::filesystem::path NewFolder();
  void Read(Job* job);
  void TakeLine(const std::string& line, Job* job);
  void Finish(int exit_code, Job* job);
  Job& Find(const std::string& job);
  void Drop(std::map<std::string, Job>::iterator job);

  std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  std::filesystem::path root_;       // of the jobs' folders; empty: not made yet
  std::map<std::string, Job> jobs_;  // by a name that begins with its number
  int count_ = 0;
  bool closed_ = false;
};

}  // namespace retarget::studio
