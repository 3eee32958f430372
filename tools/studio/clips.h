// Clips that a posture can be tried on: those named at the start, and those of the library's
// folders.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "io/load_clip.h"
#include "tools/report/report.h"

namespace retarget::studio {

class StudioClips {
 public:
  // Reads the clips that are named. Throws InputError.
  StudioClips(const std::array<io::ClipOptions, 2>& start,
              std::vector<std::filesystem::path> folders);

  // {files: [{id, name, frames?, fps?, error?}]}.
  report::Json List();
  // {a: {file, frames, fps, stature}, b: ...}; empty where none was named.
  report::Json StartJson() const;
  // Options of the command line that name a clip of the list as figure `f`'s. Throws StudioError
  // 404.
  std::vector<std::string> Arguments(const std::string& id, int f) const;
  // The clips named at the start; throws InputError where there are not two.
  std::array<const io::LoadedClip*, 2> Both() const;

 private:
  struct Listed {
    std::filesystem::file_time_type modified;
    report::Json facts;  // frames, fps, error
  };
  std::map<std::string, std::filesystem::path> Files() const;
  report::Json FactsOf(const std::filesystem::path& path);

  std::array<std::optional<io::LoadedClip>, 2> start_;
  std::vector<std::filesystem::path> folders_;
  std::mutex mutex_;
  std::map<std::string, Listed> listed_;  // by path
};

}  // namespace retarget::studio
