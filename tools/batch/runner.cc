#include "tools/batch/runner.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <filesystem>
#include <list>
#include <mutex>
#include <numeric>
#include <optional>
#include <thread>

#include "io/files.h"
#include "io/text/read_file.h"
#include "tools/report/contact_sheet.h"
#include "tools/studio/child_process.h"

namespace retarget::batch {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kUnfinished = ".unfinished";
constexpr char kSeparator = '~';  // of an id and whose folder it is; no id has one
constexpr const char* kOld = "~old";
constexpr int kPictureWidth = 240, kPictureHeight = 300;  // pixels of one instant

void LargestFirst(std::vector<Job>* jobs) {
  std::stable_sort(jobs->begin(), jobs->end(),
                   [](const Job& a, const Job& b) { return a.frames > b.frames; });
}

// Source above result, in the middle of the clip.
void DrawPicture(const fs::path& folder) {
  const io::Image sheet =
      report::ContactSheet(folder.string(), {{0.5, 35}}, false, kPictureWidth, kPictureHeight);
  io::WriteFile((folder / "scene.png").string(), io::EncodePng(sheet), true);
}

bool IsOfARun(const fs::path& folder) {
  const std::optional<std::string> report = io::TryReadFile((folder / "report.json").string());
  return report && report->find("\"generator\": \"retarget") != std::string::npos;
}

class Runner {
 public:
  Runner(std::vector<Job> jobs, const std::vector<Option>& options, const RunnerOptions& runner,
         const std::function<void(const Record&)>& finished)
      : options_(options), runner_(runner), finished_(finished) {
    LargestFirst(&jobs);
    waiting_.assign(std::make_move_iterator(jobs.begin()), std::make_move_iterator(jobs.end()));
    unfinished_ = fs::path(runner.out) / kUnfinished;
    char host[256] = "";
    gethostname(host, sizeof host - 1);
    suffix_ = fmt::format("{}{}.{}", kSeparator, host, getpid());
    RemoveLeftovers();
    studio::LetChildrenEndWithUs();
  }

  bool Run(const std::function<bool()>& stop) {
    active_ = runner_.processes;
    std::vector<std::thread> workers;
    for (int k = 0; k < runner_.processes; ++k) workers.emplace_back([this] { Work(); });
    {
      std::unique_lock lock(mutex_);
      while (!over_.wait_for(lock, std::chrono::milliseconds(100), [&] { return active_ == 0; })) {
        if (!stopped_ && (stop() || failure_)) Stop();
      }
    }
    for (std::thread& worker : workers) worker.join();
    std::error_code error;
    fs::remove(unfinished_, error);  // where it is empty
    if (failure_) std::rethrow_exception(failure_);
    return !stopped_;
  }

 private:
  // What processes that were killed have left of the shard.
  void RemoveLeftovers() {
    std::error_code error;
    fs::create_directories(unfinished_, error);
    for (const auto& entry : fs::directory_iterator(unfinished_, error)) {
      const std::string name = entry.path().filename();
      std::string id = name.substr(0, name.rfind(kSeparator));
      if (id.ends_with(kOld)) id.resize(id.size() - std::string_view(kOld).size());
      std::error_code ignored;
      if (std::find(runner_.ids.begin(), runner_.ids.end(), id) != runner_.ids.end()) {
        fs::remove_all(entry.path(), ignored);
      }
    }
  }

  // With mutex_.
  void Stop() {
    stopped_ = true;
    for (studio::ChildProcess* child : running_) child->Signal(SIGKILL);
    changed_.notify_all();
  }

  void Work() {
    try {
      while (std::optional<Job> job = Next()) RunOne(*job);
    } catch (...) {  // the disk is full
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    --active_;
    over_.notify_all();
  }

  // The largest that memory has room for.
  std::optional<Job> Next() {
    std::unique_lock lock(mutex_);
    for (;;) {
      if (stopped_ || failure_ || waiting_.empty()) return std::nullopt;
      const auto job = std::find_if(waiting_.begin(), waiting_.end(), [&](const Job& j) {
        return taken_ == 0 || taken_ + j.bytes <= runner_.memory;
      });
      if (job != waiting_.end()) {
        Job next = std::move(*job);
        waiting_.erase(job);
        taken_ += next.bytes;
        return next;
      }
      changed_.wait(lock);
    }
  }

  void RunOne(const Job& job) {
    const fs::path folder = unfinished_ / (job.pair.id + suffix_);
    const auto begin = Clock::now();
    std::string message;
    int code = 1;
    try {
      code = RunProcess(job, folder, &message);
    } catch (const std::runtime_error& error) {  // no process can be started
      message = error.what();
    }
    if (!IsStopped()) {
      const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
      Record record = RecordOf(job, code, message, seconds, folder.string());
      if (record.HasResult() && runner_.pictures) {
        try {
          DrawPicture(folder);
        } catch (const std::exception&) {  // the page shows none
        }
      }
      Keep(folder, &record);
      const std::lock_guard lock(mutex_);
      finished_(record);
    }
    std::error_code error;
    fs::remove_all(folder, error);
    const std::lock_guard lock(mutex_);
    taken_ -= job.bytes;
    changed_.notify_all();
  }

  int RunProcess(const Job& job, const fs::path& folder, std::string* message) {
    std::vector<std::string> arguments = ArgumentsOf(job.pair, options_);
    // A process whose batch is no more ends when it next tells its progress.
    arguments.push_back("--progress=json");
    arguments.push_back("--out=" + folder.string());
    studio::ChildProcess child(arguments);
    std::list<studio::ChildProcess*>::iterator at;
    {
      const std::lock_guard lock(mutex_);
      at = running_.insert(running_.end(), &child);
      if (stopped_) child.Signal(SIGKILL);
    }
    for (std::string line; child.ReadLine(&line);) {
      if (line.starts_with("retarget: ")) *message = line.substr(10);
    }
    const std::lock_guard lock(mutex_);
    running_.erase(at);
    return child.Wait();
  }

  // The line of the status file first, then the folder: a line without its folder is not finished.
  void Keep(const fs::path& folder, Record* record) {
    const fs::path place = fs::path(runner_.out) / record->id;
    std::error_code error;
    if (fs::exists(place, error)) {
      if (!runner_.force && !IsOfARun(place)) {
        record->exit_code = 2;
        record->error = place.string() + ": is there already and no run of this program wrote it";
      } else {
        const fs::path old = unfinished_ / (record->id + kOld + suffix_);
        fs::rename(place, old);
        fs::remove_all(old, error);
      }
    }
    AppendRecord(runner_.status, *record);
    if (record->HasResult()) fs::rename(folder, place);
  }

  bool IsStopped() {
    const std::lock_guard lock(mutex_);
    return stopped_;
  }

  const std::vector<Option>& options_;
  const RunnerOptions& runner_;
  const std::function<void(const Record&)>& finished_;
  fs::path unfinished_;
  std::string suffix_;

  std::mutex mutex_;  // of all that follows
  std::condition_variable changed_, over_;
  std::list<Job> waiting_;
  std::list<studio::ChildProcess*> running_;
  int64_t taken_ = 0;
  int active_ = 0;
  bool stopped_ = false;
  std::exception_ptr failure_;
};

}  // namespace

int64_t MostMemory(const std::vector<Job>& jobs, const RunnerOptions& options) {
  std::vector<int64_t> bytes;
  for (const Job& job : jobs) bytes.push_back(job.bytes);
  std::sort(bytes.rbegin(), bytes.rend());
  bytes.resize(std::min(bytes.size(), static_cast<size_t>(options.processes)));
  const int64_t all = std::accumulate(bytes.begin(), bytes.end(), int64_t{0});
  return bytes.empty() ? 0 : std::max(bytes.front(), std::min(all, options.memory));
}

bool RunJobs(std::vector<Job> jobs, const std::vector<Option>& options, const RunnerOptions& runner,
             const std::function<void(const Record&)>& finished,
             const std::function<bool()>& stop) {
  return Runner(std::move(jobs), options, runner, finished).Run(stop);
}

}  // namespace retarget::batch
