#include "io/data/npy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <functional>
#include <numeric>

#include "io/data/little_endian.h"

namespace retarget::io {
namespace {

// `type` as numpy writes it: "<f8".
std::string Header(const std::string& type, const std::vector<size_t>& shape) {
  std::string tuple;
  for (const size_t n : shape) tuple += fmt::format("{}, ", n);
  if (shape.size() > 1) tuple.resize(tuple.size() - 2);
  if (shape.size() == 1) tuple.pop_back();
  std::string text =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, tuple);
  const std::string magic = "\x93NUMPY\x01";
  const size_t before = magic.size() + 3;              // a zero, and the length of the text
  text.append(63 - (before + text.size()) % 64, ' ');  // what follows begins at 64 bytes
  text += '\n';
  std::string out = magic + '\0';
  AppendLittle<uint16_t>(static_cast<uint16_t>(text.size()), &out);
  return out + text;
}

template <typename Values>
void CheckCount(const Values& values, const std::vector<size_t>& shape) {
  const size_t count =
      std::accumulate(shape.begin(), shape.end(), size_t{1}, std::multiplies<size_t>());
  assert(values.size() == count);
  static_cast<void>(values);
  static_cast<void>(count);
}

}  // namespace

std::string FormatNpy(const std::vector<double>& values, const std::vector<size_t>& shape) {
  CheckCount(values, shape);
  std::string out = Header("<f8", shape);
  for (const double value : values) AppendLittle(value, &out);
  return out;
}

std::string FormatNpy(const std::vector<int32_t>& values, const std::vector<size_t>& shape) {
  CheckCount(values, shape);
  std::string out = Header("<i4", shape);
  for (const int32_t value : values) AppendLittle(value, &out);
  return out;
}

std::string FormatNpy(const std::vector<bool>& values, const std::vector<size_t>& shape) {
  CheckCount(values, shape);
  std::string out = Header("|b1", shape);
  for (const bool value : values) out += value ? '\1' : '\0';
  return out;
}

std::string FormatNpy(const std::vector<std::string>& texts) {
  size_t longest = 1;
  for (const std::string& text : texts) longest = std::max(longest, text.size());
  std::string out = Header(fmt::format("<U{}", longest), {texts.size()});
  for (const std::string& text : texts) {
    for (size_t k = 0; k < longest; ++k) {
      AppendLittle<uint32_t>(k < text.size() ? static_cast<uint8_t>(text[k]) : 0, &out);
    }
  }
  return out;
}

}  // namespace retarget::io
