#include "io/files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "io/text/read_file.h"
#include "model/geometry/types.h"

namespace retarget::io {
namespace {

namespace fs = std::filesystem;

bool SameFile(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return fs::exists(a, error) && fs::exists(b, error) && fs::equivalent(a, b, error);
}

void WriteTemporary(const fs::path& path, const std::string& bytes) {
  std::error_code made;  // a file that a .gltf names may lie in a folder of its own
  fs::create_directories(path.parent_path(), made);
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) {
    std::error_code error;
    fs::remove(path, error);
    throw InputError(fmt::format("{}: cannot be written", path.string()));
  }
}

fs::path TemporaryName(const fs::path& path) {
  return path.parent_path() / fmt::format(".{}.{}.part", path.filename().string(), getpid());
}

std::string TextOf(WriteRefusal::Kind kind, const std::string& path, const std::string& file) {
  switch (kind) {
    case WriteRefusal::Kind::kFileExists:
      return path + ": is there already";
    case WriteRefusal::Kind::kForeignFiles:
      return fmt::format("{}: {} is there and no earlier run wrote it", path, file);
    case WriteRefusal::Kind::kInput:
      return fmt::format("{}: would overwrite the input {}", path, file);
    case WriteRefusal::Kind::kNoFolder:
      break;
  }
  return path + ": cannot be created";
}

}  // namespace

WriteRefusal::WriteRefusal(Kind kind, const std::string& path, const std::string& file)
    : InputError(TextOf(kind, path, file)), kind_(kind), path_(path), file_(file) {}

std::string HashOf(const std::string& bytes) {
  uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : bytes) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3u;
  }
  return fmt::format("fnv1a64:{:016x}", hash);
}

OutputSet::OutputSet(const std::string& folder, const std::vector<std::string>& names,
                     const std::vector<std::string>& inputs, bool force)
    : folder_(folder) {
  std::error_code error;
  const fs::path report = fs::path(folder) / "report.json";
  bool ours = false;
  if (fs::exists(report, error)) {
    ours = ReadFile(report.string()).find("\"generator\": \"retarget") != std::string::npos;
  }
  for (const std::string& name : names) {
    const fs::path path = fs::path(folder) / name;
    for (const std::string& input : inputs) {
      if (SameFile(path, input)) {
        throw WriteRefusal(WriteRefusal::Kind::kInput, folder, input);
      }
    }
    if (fs::exists(path, error) && !ours && !force) {
      throw WriteRefusal(WriteRefusal::Kind::kForeignFiles, folder, name);
    }
  }
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder)) throw WriteRefusal(WriteRefusal::Kind::kNoFolder, folder, "");
}

void OutputSet::Add(const std::string& name, std::string bytes) {
  files_.emplace_back(name, std::move(bytes));
}

void OutputSet::Commit() {
  std::vector<std::pair<fs::path, fs::path>> renames;
  try {
    for (const auto& [name, bytes] : files_) {
      const fs::path path = fs::path(folder_) / name;
      renames.emplace_back(TemporaryName(path), path);
      WriteTemporary(renames.back().first, bytes);
    }
  } catch (...) {
    std::error_code error;
    for (const auto& [from, to] : renames) fs::remove(from, error);
    throw;
  }
  for (const auto& [from, to] : renames) fs::rename(from, to);
  files_.clear();
}

void WriteFile(const std::string& path, const std::string& bytes, bool force) {
  std::error_code error;
  if (fs::exists(path, error) && !force) {
    throw WriteRefusal(WriteRefusal::Kind::kFileExists, path, "");
  }
  const fs::path temporary = TemporaryName(path);
  WriteTemporary(temporary, bytes);
  fs::rename(temporary, path);
}

}  // namespace retarget::io
