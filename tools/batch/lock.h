// One process at a time works on a shard in a folder.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

namespace retarget::batch {

// Holds a lock file for as long as it lives; a process that is killed lets go. Where the file
// system knows no locks there is none. Throws InputError where another process holds it.
class ShardLock {
 public:
  explicit ShardLock(const std::string& path);

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

}  // namespace retarget::batch
