// Any bytes as a BVH file: read, recognised and written back, or refused with one line.
#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/io/bvh/bvh_damage.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  retarget::ReadsOrRefuses(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
