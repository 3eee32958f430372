#include "tools/studio/jobs.h"

#include <fmt/format.h>

#include <csignal>
#include <cstdlib>

#include "io/files.h"
#include "io/text/read_file.h"
#include "tools/report/verdict.h"
#include "tools/studio/error.h"
#include "tools/studio/guard.h"

namespace retarget::studio {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostJobs = 4;  // whose files are kept
constexpr int kMostLogLines = 2000;

// RFC: HTML living standard, server-sent events.
std::string Event(const std::string& name, const report::Json& data) {
  return fmt::format("event: {}\ndata: {}\n", name,
                     data.dump(-1, ' ', false, report::Json::error_handler_t::replace));
}

// A name as that of a file.
std::string PlainName(const std::string& name) {
  std::string plain;
  for (const char c : name.substr(0, 60)) {
    plain += isalnum(static_cast<unsigned char>(c)) ? c : '_';
  }
  return plain.empty() ? "posture" : plain;
}

// An iteration as the child tells it; null where the line is something else.
report::Json IterationOf(const std::string& line) {
  if (!line.starts_with("{\"stage\":")) return nullptr;
  const report::Json json = report::Json::parse(line, nullptr, false);
  return json.is_object() ? json : report::Json(nullptr);
}

}  // namespace

StudioJobs::~StudioJobs() { Close(); }

fs::path StudioJobs::NewFolder() {
  if (root_.empty()) {
    std::string name = (fs::temp_directory_path() / "retarget-studio-XXXXXX").string();
    if (!mkdtemp(name.data())) {
      throw StudioError(500, "the folder for temporary files cannot be written");
    }
    root_ = name;
  }
  const fs::path folder = root_ / std::to_string(count_);
  fs::create_directory(folder);
  return folder;
}

std::string StudioJobs::Start(const SolveRequest& request) {
  const std::lock_guard lock(mutex_);
  if (closed_) throw StudioError(409, "the studio is ending");
  for (const auto& [id, job] : jobs_) {
    if (!job.over) throw StudioError(409, "a solve is running; stop it first", "running");
  }
  while (jobs_.size() >= kMostJobs) Drop(jobs_.begin());
  const std::string id = fmt::format("{:06}-{}", ++count_, RandomToken());
  Job& job = jobs_[id];
  try {
    job.folder = NewFolder();
    const fs::path posture = job.folder / (PlainName(request.template_name) + ".yaml");
    io::WriteFile(posture.string(), request.template_text, true);
    std::vector<std::string> arguments = request.arguments;
    for (const std::string& more :
         {std::string("--template"), posture.string(), std::string("--out"),
          (job.folder / "out").string(), std::string("--progress"), std::string("json")}) {
      arguments.push_back(more);
    }
    job.child = std::make_unique<ChildProcess>(arguments);
    job.reader = std::thread([this, &job] { Read(&job); });
  } catch (...) {
    jobs_.erase(id);
    throw;
  }
  return id;
}

// In a thread of its own: the child belongs to it, save for signals.
void StudioJobs::Read(Job* job) {
  std::string line;
  while (job->child->ReadLine(&line)) {
    const std::lock_guard lock(mutex_);
    TakeLine(line, job);
    changed_.notify_all();
  }
  const std::lock_guard lock(mutex_);
  try {
    Finish(job->child->Wait(), job);
  } catch (const std::exception& error) {
    job->events.push_back(Event("failed", {{"error", error.what()}}));
  }
  job->over = true;
  changed_.notify_all();
}

void StudioJobs::TakeLine(const std::string& line, Job* job) {
  const report::Json iteration = IterationOf(line);
  if (!iteration.is_null()) {
    job->iterates = true;
    job->events.push_back(Event("progress", iteration));
    return;
  }
  if (!line.empty()) job->last_line = line;
  if (++job->log_lines <= kMostLogLines) job->events.push_back(Event("log", {{"line", line}}));
}

void StudioJobs::Finish(int exit_code, Job* job) {
  if (!fs::exists(job->folder / "out" / "report.json")) {
    std::string error = job->last_line;
    if (error.starts_with("retarget: ")) error.erase(0, 10);
    if (job->stopped) error = "stopped before there was a result";
    if (error.empty()) error = fmt::format("the solve ended without a result (code {})", exit_code);
    job->events.push_back(Event("failed", {{"error", error}, {"stopped", job->stopped}}));
    return;
  }
  const report::Json report = report::ReadReport((job->folder / "out").string());
  const report::Verdict verdict = report::VerdictOf(report);
  job->events.push_back(
      Event("done", {{"exit_code", exit_code},
                     {"met", verdict.met},
                     {"verdict", verdict.outcome},
                     {"sentences", report::VerdictSentences(report)},
                     {"requirements", report.value("requirements", report::Json::array())},
                     {"stopped", job->stopped},
                     {"report", true}}));
}

void StudioJobs::Stop(const std::string& id) {
  const std::lock_guard lock(mutex_);
  Job& job = Find(id);
  if (job.over) return;
  job.child->Signal(job.iterates && !job.stopped ? SIGINT : SIGKILL);
  job.stopped = true;
}

bool StudioJobs::NextEvents(const std::string& id, size_t* cursor, std::string* text) {
  std::unique_lock lock(mutex_);
  const auto news = [&] {
    const auto job = jobs_.find(id);
    return closed_ || job == jobs_.end() || job->second.over || job->second.events.size() > *cursor;
  };
  changed_.wait_for(lock, std::chrono::seconds(1), news);
  const auto job = jobs_.find(id);
  if (closed_ || job == jobs_.end()) return false;
  const std::vector<std::string>& events = job->second.events;
  for (; *cursor < events.size(); ++*cursor) {
    *text += fmt::format("id: {}\n{}\n", *cursor + 1, events[*cursor]);
  }
  return !job->second.over;
}

bool StudioJobs::Knows(const std::string& id) {
  const std::lock_guard lock(mutex_);
  return jobs_.contains(id);
}

std::string StudioJobs::File(const std::string& id, const std::string& name) {
  const std::lock_guard lock(mutex_);
  const Job& job = Find(id);
  std::error_code error;
  for (const auto& item : fs::directory_iterator(job.folder / "out", error)) {
    if (item.path().filename() == name && item.is_regular_file(error)) {
      return io::ReadFile(item.path().string());
    }
  }
  throw StudioError(404, "this solve wrote no such file");
}

StudioJobs::Job& StudioJobs::Find(const std::string& id) {
  const auto job = jobs_.find(id);
  if (job == jobs_.end()) throw StudioError(404, "this solve is over and its files are gone");
  return job->second;
}

void StudioJobs::Drop(std::map<std::string, Job>::iterator job) {
  job->second.reader.join();  // is over
  std::error_code error;
  fs::remove_all(job->second.folder, error);
  jobs_.erase(job);
}

void StudioJobs::Close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    for (auto& [id, job] : jobs_) {
      if (!job.over) job.child->Signal(SIGKILL);
    }
    changed_.notify_all();
  }
  for (auto& [id, job] : jobs_) {
    if (job.reader.joinable()) job.reader.join();
  }
  std::error_code error;
  if (!root_.empty()) fs::remove_all(root_, error);
}

}  // namespace retarget::studio
