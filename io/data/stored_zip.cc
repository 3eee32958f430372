#include "io/data/stored_zip.h"

#include <array>
#include <cstdint>

#include "io/data/little_endian.h"
#include "model/geometry/types.h"

namespace retarget::io {
namespace {

constexpr uint32_t kLocalHeader = 0x04034b50, kCentralHeader = 0x02014b50, kEnd = 0x06054b50;
constexpr uint16_t kVersion = 20;     // that is needed to unpack it
constexpr uint16_t kFirstDay = 0x21;  // 1 January 1980, in the words of MS-DOS

// CRC-32 of ISO 3309, bit by bit reversed.
uint32_t Crc32(const std::string& bytes) {
  static const std::array<uint32_t, 256> table = [] {
    std::array<uint32_t, 256> t{};
    for (uint32_t k = 0; k < 256; ++k) {
      uint32_t c = k;
      for (int bit = 0; bit < 8; ++bit) c = (c & 1) != 0 ? 0xedb88320u ^ (c >> 1) : c >> 1;
      t[k] = c;
    }
    return t;
  }();
  uint32_t crc = 0xffffffffu;
  for (const char c : bytes) crc = table[(crc ^ static_cast<uint8_t>(c)) & 0xff] ^ (crc >> 8);
  return crc ^ 0xffffffffu;
}

// What both headers of a file have in common.
void AppendFacts(const std::string& name, size_t bytes, uint32_t crc, std::string* out) {
  const auto size = static_cast<uint32_t>(bytes);
  AppendLittle<uint16_t>(kVersion, out);
  AppendLittle<uint16_t>(0, out);  // flags
  AppendLittle<uint16_t>(0, out);  // stored
  AppendLittle<uint16_t>(0, out);  // time
  AppendLittle<uint16_t>(kFirstDay, out);
  AppendLittle<uint32_t>(crc, out);
  AppendLittle<uint32_t>(size, out);
  AppendLittle<uint32_t>(size, out);
  AppendLittle<uint16_t>(static_cast<uint16_t>(name.size()), out);
  AppendLittle<uint16_t>(0, out);  // extra field
}

}  // namespace

std::string FormatStoredZip(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string zip, directory;
  for (const auto& [name, bytes] : files) {
    if (zip.size() + bytes.size() > 0xf0000000u) {
      throw InputError(
          "an archive of more than 4 GB cannot be written; solve fewer frames at once");
    }
    const uint32_t crc = Crc32(bytes);
    AppendLittle<uint32_t>(kCentralHeader, &directory);
    AppendLittle<uint16_t>(kVersion, &directory);
    AppendFacts(name, bytes.size(), crc, &directory);
    AppendLittle<uint16_t>(0, &directory);  // comment
    AppendLittle<uint16_t>(0, &directory);  // disk
    AppendLittle<uint16_t>(0, &directory);  // internal attributes
    AppendLittle<uint32_t>(0, &directory);  // external attributes
    AppendLittle<uint32_t>(static_cast<uint32_t>(zip.size()), &directory);
    directory += name;
    AppendLittle<uint32_t>(kLocalHeader, &zip);
    AppendFacts(name, bytes.size(), crc, &zip);
    zip += name + bytes;
  }
  const auto start = static_cast<uint32_t>(zip.size());
  const auto count = static_cast<uint16_t>(files.size());
  zip += directory;
  AppendLittle<uint32_t>(kEnd, &zip);
  AppendLittle<uint16_t>(0, &zip);  // disk
  AppendLittle<uint16_t>(0, &zip);
  AppendLittle<uint16_t>(count, &zip);
  AppendLittle<uint16_t>(count, &zip);
  AppendLittle<uint32_t>(static_cast<uint32_t>(directory.size()), &zip);
  AppendLittle<uint32_t>(start, &zip);
  AppendLittle<uint16_t>(0, &zip);  // comment
  return zip;
}

}  // namespace retarget::io
