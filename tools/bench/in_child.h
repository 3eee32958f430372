// Runs a measurement in a process of its own, so that its peak of memory is its own.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <type_traits>

namespace retarget {

// The value of `work()`, worked out in a forked child. The caller must be small and have one
// thread: a child's peak begins at what its parent holds. Throws where the child fails.
template <typename Work>
auto InChild(const Work& work) {
  using Result = decltype(work());
  static_assert(std::is_trivially_copyable_v<Result>, "goes through a pipe");
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe to a child process");
  std::fflush(stdout);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no child process");
  if (child == 0) {
    int code = 1;
    try {
      const Result result = work();
      code = write(ends[1], &result, sizeof result) == sizeof result ? 0 : 1;
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
    _exit(code);
  }
  close(ends[1]);
  Result result;
  const bool whole = read(ends[0], &result, sizeof result) == sizeof result;
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!whole || status != 0) throw std::runtime_error("a measurement failed in its process");
  return result;
}

}  // namespace retarget
