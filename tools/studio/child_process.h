// Another program, run beside this one: what it says is read line by line, and it can be ended at
// any time.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace retarget::studio {

class ChildProcess {
 public:
  // This very program with other arguments; standard output and error come as one. Throws
  // std::runtime_error.
  explicit ChildProcess(const std::vector<std::string>& arguments);
  ~ChildProcess();  // kills it where it still runs
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Waits for the next line; false: it says no more.
  bool ReadLine(std::string* line);
  // Waits for its end: the exit code, or 128 + the signal that ended it.
  int Wait();
  // Does nothing after Wait.
  void Signal(int signal);

 private:
  pid_t pid_ = -1;
  int output_ = -1;
  std::string unread_;
};

// From here on every ChildProcess ends with the thread that has started it, even if that is killed.
// To be called while there is one thread alone.
void LetChildrenEndWithUs();
// In the child: does what its parent has asked for.
void EndWithParentIfAsked();

// Starts another program and leaves it alone; its output goes nowhere. False where it cannot be
// started.
bool Launch(const std::vector<std::string>& words);

}  // namespace retarget::studio
