#include "tools/studio/clips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/text/quoted.h"
#include "tools/studio/error.h"

namespace retarget::studio {
namespace {

namespace fs = std::filesystem;

constexpr uintmax_t kLargestCounted = 32 << 20;  // bytes: larger files are listed unread

bool IsClip(const fs::path& path) {
  static const std::vector<std::string> extensions = {".bvh", ".glb", ".vrm", ".vrma"};
  const std::string own = path.extension().string();
  return std::find(extensions.begin(), extensions.end(), own) != extensions.end();
}

std::string StartId(int f) { return std::string("start/") + report::kFigure[f]; }

}  // namespace

StudioClips::StudioClips(const std::array<io::ClipOptions, 2>& start, std::vector<fs::path> folders)
    : folders_(std::move(folders)) {
  for (int f = 0; f < 2; ++f) {
    if (!start[f].path.empty()) start_[f] = io::LoadClip(start[f]);
  }
}

// By id. Links are followed nowhere.
std::map<std::string, fs::path> StudioClips::Files() const {
  std::map<std::string, fs::path> files;
  std::error_code error;
  const auto add = [&](const fs::path& path, const std::string& id) {
    if (IsClip(path) && fs::symlink_status(path, error).type() == fs::file_type::regular) {
      files.emplace(id, path);
    }
  };
  for (const fs::path& folder : folders_) {
    for (const auto& item : fs::directory_iterator(folder, error)) {
      const std::string name = item.path().filename().string();
      add(item.path(), name);
      if (item.symlink_status(error).type() != fs::file_type::directory) continue;
      for (const auto& inner : fs::directory_iterator(item.path(), error)) {
        add(inner.path(), name + "/" + inner.path().filename().string());
      }
    }
  }
  return files;
}

report::Json StudioClips::FactsOf(const fs::path& path) {
  std::error_code error;
  const auto modified = fs::last_write_time(path, error);
  Listed& known = listed_[path.string()];
  if (!known.facts.is_null() && known.modified == modified) return known.facts;
  known = {modified, report::Json::object()};
  if (fs::file_size(path, error) > kLargestCounted || error) return known.facts;
  try {
    const io::ClipFile file = io::ReadClipFile(path.string());
    if (file.has_motion) {
      known.facts["frames"] = file.motion.num_frames();
      known.facts["fps"] = std::round(100 / file.motion.frame_time) / 100;
    } else {
      known.facts["error"] = "is a character without animation";
    }
  } catch (const InputError& refusal) {
    known.facts["error"] = refusal.what();
  }
  return known.facts;
}

report::Json StudioClips::List() {
  const std::lock_guard lock(mutex_);
  report::Json files = report::Json::array();
  for (int f = 0; f < 2; ++f) {
    if (!start_[f]) continue;
    files.push_back({{"id", StartId(f)},
                     {"name", fs::path(start_[f]->options.path).filename().string()},
                     {"frames", start_[f]->file.motion.num_frames()}});
  }
  for (const auto& [id, path] : Files()) {
    report::Json entry = {{"id", id}, {"name", id}};
    entry.update(FactsOf(path));
    files.push_back(entry);
  }
  return {{"files", files}};
}

report::Json StudioClips::StartJson() const {
  report::Json out = report::Json::object();
  for (int f = 0; f < 2; ++f) {
    if (!start_[f]) continue;
    const RigMotion& motion = start_[f]->file.motion;
    out[report::kFigure[f]] = {{"file", fs::path(start_[f]->options.path).filename().string()},
                               {"id", StartId(f)},
                               {"frames", motion.num_frames()},
                               {"fps", std::round(100 / motion.frame_time) / 100},
                               {"stature", start_[f]->body.stature}};
  }
  return out;
}

std::vector<std::string> StudioClips::Arguments(const std::string& id, int f) const {
  const std::string figure = report::kFigure[f];
  for (int s = 0; s < 2; ++s) {
    if (!start_[s] || id != StartId(s)) continue;
    const io::ClipOptions& own = start_[s]->options;
    std::vector<std::string> arguments = {"--clip-" + figure, own.path};
    const std::pair<const char*, std::string> options[] = {
        {"--units-", own.units},
        {"--up-", own.up},
        {"--map-", own.map},
        {"--skip-frames-", own.skip_frames ? std::to_string(own.skip_frames) : ""},
        {"--ik-targets-", own.ik_targets != "follow" ? own.ik_targets : ""},
        {"--amc-fps-", own.amc_fps != 120 ? fmt::format("{}", own.amc_fps) : ""}};
    for (const auto& [name, value] : options) {
      if (value.empty()) continue;
      arguments.push_back(name + figure);
      arguments.push_back(value);
    }
    return arguments;
  }
  const auto files = Files();
  const auto file = files.find(id);
  if (file == files.end()) {
    throw StudioError(404, fmt::format("there is no clip \"{}\"", io::Printable(id)));
  }
  return {"--clip-" + figure, file->second.string()};
}

std::array<const io::LoadedClip*, 2> StudioClips::Both() const {
  if (!start_[0] || !start_[1]) {
    throw InputError("clips: expected the studio to be started with --clip-a and --clip-b");
  }
  return {&*start_[0], &*start_[1]};
}

}  // namespace retarget::studio
