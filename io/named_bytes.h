// A file in memory.
#pragma once

#include <string>

namespace retarget::io {

struct NamedBytes {
  std::string name, bytes;
};

}  // namespace retarget::io
