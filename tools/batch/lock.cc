#include "tools/batch/lock.h"

#include <fmt/format.h>
#include <sys/file.h>

#include <cerrno>

#include "model/geometry/types.h"

namespace retarget::batch {

ShardLock::ShardLock(const std::string& path)
    : file_(std::fopen(path.c_str(), "ab"), &std::fclose) {
  if (!file_) throw InputError(path + ": cannot be written");
  if (flock(fileno(file_.get()), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    throw InputError(
        fmt::format("{}: another process runs these pairs; wait for it, or end it", path));
  }
}

}  // namespace retarget::batch
