#include "tools/batch/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include "io/clip_file.h"
#include "io/settings_file.h"
#include "io/sha256.h"
#include "io/text/read_file.h"
#include "tools/api/retarget.h"
#include "tools/batch/manifest_paths.h"

namespace retarget::batch {
namespace {

// Measured: 230 MB up to 300 frames, 488 MB for 1201, 1176 MB for 3001. A quarter more than that.
constexpr int64_t kBytesOfProcess = 280'000'000;
constexpr int64_t kBytesPerFrame = 400'000;

bool IsSetting(const std::string& column) { return column.find('.') != std::string::npos; }

// What is known of a file; clips are read once for all pairs that share them.
struct FileFacts {
  std::string hash;
  double seconds = -1;  // of a clip that can be read
};

class Files {
 public:
  FileFacts Clip(const std::string& path, double amc_fps) {
    FileFacts& facts = known_[fmt::format("{} {}", amc_fps, path)];
    if (!facts.hash.empty()) return facts;
    try {
      const io::ClipFile clip = io::ReadClipFile(io::ParseClipPath(path), amc_fps);
      facts.hash = io::Sha256Of(clip.bytes);
      facts.seconds = (clip.motion.num_frames() - 1) * clip.motion.frame_time;
    } catch (const std::exception&) {
      facts.hash = Other(path);
    }
    return facts;
  }

  std::string Other(const std::string& path) {
    FileFacts& facts = known_[path];
    if (facts.hash.empty()) {
      const std::optional<std::string> bytes = io::TryReadFile(path);
      facts.hash = bytes ? io::Sha256Of(*bytes) : "missing";
    }
    return facts.hash;
  }

 private:
  std::map<std::string, FileFacts> known_;
};

double NumberIn(const Pair& pair, const std::string& column, double otherwise) {
  const std::string text = pair.Column(column);
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0' ? number : otherwise;
}

// The effective settings as text; what is asked for as it stands where that is no settings.
std::string SettingsText(const Pair& pair) {
  std::string as_written;
  for (const auto& [column, value] : pair.columns) {
    if (IsSetting(column)) as_written += column + "=" + value + "\n";
  }
  try {
    const std::string config = pair.Column("config");
    Settings settings = config.empty() ? Settings{} : io::ReadSettings(config);
    for (const auto& [column, value] : pair.columns) {
      if (IsSetting(column)) io::SetByName(&settings, column + "=" + value);
    }
    return io::FormatSettings(settings);
  } catch (const InputError&) {
    return as_written;
  }
}

int FramesOf(const Pair& pair, double seconds) {
  const double fps = NumberIn(pair, "fps", 30);
  int first = 0, last = 0;
  if (std::sscanf(pair.Column("frames").c_str(), "%d:%d", &first, &last) == 2) {
    return std::max(0, last - first);
  }
  return seconds < 0 ? 0 : static_cast<int>(seconds * fps + 1e-3) + 1;
}

Job JobOf(const Pair& pair, Files* files) {
  Job job{pair, 0, "", 0, 0};
  std::string all = fmt::format("retarget {}\n{}", Version(), SettingsText(pair));
  double seconds = 1e300;
  std::vector<std::string> lines;
  for (const auto& [column, value] : pair.columns) {
    if (IsSetting(column)) continue;
    if (column == "clip-a" || column == "clip-b") {
      const std::string figure = column.substr(4);
      const FileFacts facts = files->Clip(value, NumberIn(pair, "amc-fps" + figure, 120));
      seconds = std::min(
          seconds, facts.seconds < 0 ? -1 : facts.seconds - NumberIn(pair, "start" + figure, 0));
      // What stands after '#' chooses in the file.
      const size_t select = value.rfind('#');
      lines.push_back(fmt::format("{}={} {}\n", column, facts.hash,
                                  select == std::string::npos ? "" : value.substr(select)));
    } else if (IsPathColumn(column)) {
      lines.push_back(fmt::format("{}={}\n", column, files->Other(value)));
    } else {
      lines.push_back(fmt::format("{}={}\n", column, value));
    }
  }
  std::sort(lines.begin(), lines.end());
  for (const std::string& line : lines) all += line;
  job.hash = io::Sha256Of(all);
  job.frames = FramesOf(pair, seconds);
  job.bytes = kBytesOfProcess + kBytesPerFrame * job.frames;
  return job;
}

}  // namespace

std::vector<Job> PlanJobs(const std::vector<Pair>& pairs, const Shard& shard) {
  Files files;
  std::vector<Job> jobs;
  for (size_t k = static_cast<size_t>(shard.index); k < pairs.size();
       k += static_cast<size_t>(shard.count)) {
    jobs.push_back(JobOf(pairs[k], &files));
    jobs.back().index = k;
  }
  return jobs;
}

std::vector<std::string> ArgumentsOf(const Pair& pair, const std::vector<Option>& options) {
  std::vector<std::string> arguments;
  bool threads = false;
  for (const auto& [column, value] : pair.columns) {
    threads |= column == "threads" || column == "solve.threads";
    const bool flag = std::any_of(options.begin(), options.end(),
                                  [&](const Option& o) { return o.name == column && o.is_flag; });
    if (IsSetting(column)) {
      arguments.push_back(fmt::format("--set={}={}", column, value));
    } else if (!flag) {
      arguments.push_back(fmt::format("--{}={}", column, value));
    } else if (value == "true") {
      arguments.push_back("--" + column);
    }
  }
  // Pairs side by side use the processors better than threads do, and results do not depend on
  // the machine.
  if (!threads) arguments.push_back("--threads=1");
  return arguments;
}

}  // namespace retarget::batch
