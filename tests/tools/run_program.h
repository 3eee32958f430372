// Runs the built program as a user would, in a folder of its own.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "tests/test_data.h"

namespace retarget {

namespace fs = std::filesystem;

struct Outcome {
  int code;
  std::string out, err;
};

// A folder that goes away with the test.
class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "retarget-test-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Scratch() { fs::remove_all(path_); }
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  std::string Write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ + "/" + name, std::ios::binary) << text;
    return path_ + "/" + name;
  }

 private:
  std::string path_;
};

inline Outcome RunProgram(const Scratch& scratch, const std::string& arguments) {
  const std::string out = scratch / "stdout.txt", err = scratch / "stderr.txt";
  const std::string command =
      std::string(RETARGET_BINARY) + " " + arguments + " >" + out + " 2>" + err;
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, ReadWholeFile(out), ReadWholeFile(err)};
}

inline const std::string kHold = ProjectPath("data/holds/bear_hug");
inline const std::string kExample = "--clip-a " + kHold + "/a.bvh --clip-b " + kHold +
                                    "/b.bvh --template " + kHold + "/template.yaml";

}  // namespace retarget
