#include "tools/studio/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace retarget::studio {
namespace {

constexpr size_t kLongestLine = 10'000;  // bytes; the rest of a longer one is a line of its own
constexpr const char* kParentVariable = "RETARGET_PARENT_PROCESS";
constexpr int kNice = 5;  // a drag on the page goes first

// How the child is started: no files of ours but the pipe, no signals blocked, a group of its own,
// so that Ctrl-C in the terminal is ours to hand on.
class SpawnSettings {
 public:
  explicit SpawnSettings(int output) {
    posix_spawn_file_actions_init(&files_);
    posix_spawn_file_actions_addopen(&files_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files_, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files_, output, STDERR_FILENO);
    posix_spawn_file_actions_addclosefrom_np(&files_, STDERR_FILENO + 1);
    posix_spawnattr_init(&attributes_);
    sigset_t none, usual;
    sigemptyset(&none);
    sigemptyset(&usual);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) sigaddset(&usual, signal);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &usual);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(
        &attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  const posix_spawn_file_actions_t* files() const { return &files_; }
  const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  posix_spawn_file_actions_t files_;
  posix_spawnattr_t attributes_;
};

std::vector<char*> Argv(const std::vector<std::string>& words) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  return argv;
}

}  // namespace

void LetChildrenEndWithUs() { setenv(kParentVariable, std::to_string(getpid()).c_str(), 1); }

void EndWithParentIfAsked() {
  const char* parent = std::getenv(kParentVariable);
  if (parent == nullptr) return;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const bool is_gone = std::to_string(getppid()) != parent;
  unsetenv(kParentVariable);
  if (is_gone) std::_Exit(1);
}

bool Launch(const std::vector<std::string>& words) {
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  pid_t pid;
  const SpawnSettings settings(nowhere);
  const int error = posix_spawnp(&pid, words[0].c_str(), settings.files(), settings.attributes(),
                                 Argv(words).data(), environ);
  close(nowhere);
  return error == 0;
}

ChildProcess::ChildProcess(const std::vector<std::string>& arguments) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(std::strerror(errno));
  output_ = ends[0];
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), "retarget");
  const SpawnSettings settings(ends[1]);
  const int error = posix_spawn(&pid_, "/proc/self/exe", settings.files(), settings.attributes(),
                                Argv(words).data(), environ);
  close(ends[1]);
  if (error != 0) {
    close(output_);
    throw std::runtime_error(std::string("retarget cannot be started: ") + std::strerror(error));
  }
  setpriority(PRIO_PROCESS, static_cast<id_t>(pid_), kNice);
}

ChildProcess::~ChildProcess() {
  Signal(SIGKILL);
  Wait();
  close(output_);
}

bool ChildProcess::ReadLine(std::string* line) {
  for (;;) {
    const size_t end = unread_.find('\n');
    if (end != std::string::npos || unread_.size() >= kLongestLine) {
      const size_t length = std::min(end, kLongestLine);
      *line = unread_.substr(0, length);
      unread_.erase(0, length == end ? end + 1 : length);
      return true;
    }
    char bytes[4096];
    const ssize_t count = read(output_, bytes, sizeof bytes);
    if (count < 0 && errno == EINTR) continue;
    if (count > 0) {
      unread_.append(bytes, static_cast<size_t>(count));
      continue;
    }
    *line = std::move(unread_);
    unread_.clear();
    return !line->empty();
  }
}

int ChildProcess::Wait() {
  if (pid_ < 0) return -1;
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void ChildProcess::Signal(int signal) {
  if (pid_ > 0) kill(pid_, signal);
}

}  // namespace retarget::studio
