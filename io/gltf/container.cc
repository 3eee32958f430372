#include "io/gltf/container.h"

#include <fmt/format.h>

#include <cstdint>

#include "model/geometry/types.h"

namespace retarget::io {
namespace {

constexpr size_t kHeader = 12, kChunkHeader = 8;
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2;
constexpr std::uint32_t kJson = 0x4E4F534A, kBin = 0x004E4942;

std::uint32_t WordAt(std::string_view bytes, size_t offset) {
  std::uint32_t word = 0;
  for (int i = 3; i >= 0; --i) word = word << 8 | static_cast<unsigned char>(bytes[offset + i]);
  return word;
}

void AppendWord(size_t value, std::string* out) {
  for (int i = 0; i < 4; ++i) out->push_back(static_cast<char>(value >> (8 * i) & 0xFF));
}

[[noreturn]] void Damaged(const std::string& name, const std::string& what) {
  throw InputError(fmt::format("{}: damaged GLB: {}", name, what));
}

GltfContainer SplitGlb(std::string_view bytes, const std::string& name) {
  if (bytes.size() < kHeader + kChunkHeader) Damaged(name, "the file ends within its header");
  if (WordAt(bytes, 4) != kVersion) {
    throw InputError(
        fmt::format("{}: GLB version {}, expected {}", name, WordAt(bytes, 4), kVersion));
  }
  if (WordAt(bytes, 8) != bytes.size()) {
    Damaged(name, fmt::format("the header promises {} bytes, the file has {}", WordAt(bytes, 8),
                              bytes.size()));
  }
  GltfContainer out;
  out.binary = true;
  int chunk = 0;
  bool json_seen = false, bin_seen = false;
  for (size_t at = kHeader; at < bytes.size(); ++chunk) {
    if (bytes.size() - at < kChunkHeader) Damaged(name, "the last chunk has no header");
    const size_t length = WordAt(bytes, at);
    const std::uint32_t type = WordAt(bytes, at + 4);
    if (bytes.size() - at - kChunkHeader < length) {
      Damaged(name, fmt::format("chunk {} reaches beyond the file", chunk));
    }
    if (length % 4 != 0) Damaged(name, fmt::format("chunk {} is no multiple of 4 bytes", chunk));
    const std::string_view content = bytes.substr(at + kChunkHeader, length);
    if ((type == kJson) != (chunk == 0)) Damaged(name, "the JSON chunk must be the first, once");
    if (type == kBin && chunk != 1) Damaged(name, "the BIN chunk must be the second, once");
    if (type == kJson) {
      out.json = content;
      json_seen = true;
    }
    if (type == kBin) {
      out.data = content;
      bin_seen = true;
    }
    at += kChunkHeader + length;
    if (chunk == (bin_seen ? 1 : 0)) out.rest = bytes.substr(at);
  }
  if (!json_seen) Damaged(name, "no JSON chunk");
  return out;
}

// Levels of brackets, as far as they count outside strings.
bool NestedTooDeep(std::string_view json) {
  constexpr int kDeepest = 200;
  int depth = 0;
  bool in_string = false;
  for (size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepest) return true;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return false;
}

}  // namespace

GltfContainer SplitGltf(std::string_view bytes, const std::string& name) {
  if (bytes.empty()) throw InputError(name + ": damaged: the file is empty");
  if (bytes.size() > UINT32_MAX) throw InputError(name + ": more than 4 GiB");
  GltfContainer out;
  if (bytes.size() >= 4 && WordAt(bytes, 0) == kMagic) {
    out = SplitGlb(bytes, name);
  } else {
    out.json = bytes;
  }
  if (NestedTooDeep(out.json)) throw InputError(name + ": the JSON text is nested too deep");
  return out;
}

std::string JoinGlb(std::string_view json, std::string_view data, std::string_view rest) {
  const auto padded = [](size_t size) { return (size + 3) / 4 * 4; };
  const size_t data_chunk = data.empty() ? 0 : kChunkHeader + padded(data.size());
  const size_t total = kHeader + kChunkHeader + padded(json.size()) + data_chunk + rest.size();
  if (total > UINT32_MAX) throw InputError("the GLB file would exceed 4 GiB");
  std::string out;
  out.reserve(total);
  AppendWord(kMagic, &out);
  AppendWord(kVersion, &out);
  AppendWord(total, &out);
  AppendWord(padded(json.size()), &out);
  AppendWord(kJson, &out);
  out += json;
  out.append(padded(json.size()) - json.size(), ' ');
  if (!data.empty()) {
    AppendWord(padded(data.size()), &out);
    AppendWord(kBin, &out);
    out += data;
    out.append(padded(data.size()) - data.size(), '\0');
  }
  out += rest;
  return out;
}

}  // namespace retarget::io
