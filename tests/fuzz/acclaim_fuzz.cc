// Any bytes as an ASF and an AMC file, with a form feed between them: read, recognised and written
// back, or refused with one line.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/io/acclaim/acclaim_damage.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const size_t cut = std::min(text.find('\f'), size);
  retarget::ReadsOrRefusesAcclaim(text.substr(0, cut), text.substr(std::min(cut + 1, size)));
  return 0;
}
