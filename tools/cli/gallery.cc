// `retarget gallery`: runs holds and writes a page of them.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "io/files.h"
#include "io/template_file.h"
#include "io/text/read_file.h"
#include "tools/cli/commands.h"
#include "tools/report/contact_sheet.h"
#include "tools/report/gallery_page.h"
#include "tools/report/html.h"

namespace retarget::cli {
namespace {

namespace fs = std::filesystem;

constexpr size_t kOverviewColumns = 5;
constexpr int kPicture = 260;  // pixels

// A folder with template.yaml and two clips, called a and b, of any format.
struct HoldFolder {
  std::string name, folder;
  RetargetOptions run;
};

bool IsHold(const fs::path& folder) { return fs::exists(folder / "template.yaml"); }

std::string ClipIn(const fs::path& folder, const std::string& stem) {
  for (const char* extension : {".bvh", ".glb", ".gltf", ".vrm"}) {
    if (fs::exists(folder / (stem + extension))) return folder / (stem + extension);
  }
  if (fs::exists(folder / (stem + ".amc"))) {
    return (folder / (stem + ".asf")).string() + ":" + (folder / (stem + ".amc")).string();
  }
  throw InputError(fmt::format("{}: found no clip {}.bvh, .glb, .gltf, .vrm or .amc, expected one",
                               folder.string(), stem));
}

// A folder is a hold, or holds are its folders.
std::vector<HoldFolder> FindHolds(const std::vector<std::string>& folders,
                                  const GalleryOptions& options) {
  std::vector<fs::path> found;
  for (const std::string& folder : folders) {
    if (IsHold(folder)) {
      found.push_back(folder);
      continue;
    }
    const size_t before = found.size();
    if (fs::is_directory(folder)) {
      for (const auto& entry : fs::directory_iterator(folder)) {
        if (IsHold(entry.path())) found.push_back(entry.path());
      }
    }
    if (found.size() == before) {
      throw InputError(folder +
                       ": found no template.yaml there or in a folder of it, expected a "
                       "hold: template.yaml and clips a.bvh and b.bvh");
    }
    std::sort(found.begin() + static_cast<long>(before), found.end());
  }
  std::vector<HoldFolder> holds;
  for (const fs::path& path : found) {
    const fs::path folder = path.filename().empty() ? path.parent_path() : path;
    HoldFolder hold{folder.filename(), folder, {}};
    if (std::any_of(holds.begin(), holds.end(),
                    [&](const HoldFolder& h) { return h.name == hold.name; })) {
      throw InputError(folder.string() + ": a second hold called \"" + hold.name + "\"");
    }
    hold.run.clip[0].option = "a";
    hold.run.clip[1].option = "b";
    for (io::ClipOptions& clip : hold.run.clip) clip.words = ProgramWords();
    hold.run.clip[0].path = ClipIn(folder, "a");
    hold.run.clip[1].path = ClipIn(folder, "b");
    hold.run.template_path = folder / "template.yaml";
    hold.run.config_path = options.config_path;
    hold.run.set = options.set;
    hold.run.threads = options.threads;
    hold.run.out = options.out + "/" + hold.name;
    hold.run.force = options.force;
    hold.run.quiet = true;
    holds.push_back(std::move(hold));
  }
  return holds;
}

// The text of the hold's README, without its title; empty where there is none.
std::string TextOf(const HoldFolder& hold) {
  const std::string path = hold.folder + "/README.md";
  if (!fs::exists(path)) return "";
  std::string text = io::ReadFile(path);
  if (text.rfind("# ", 0) == 0) text.erase(0, text.find('\n'));
  return text;
}

}  // namespace

int RunGallery(const GalleryOptions& options) {
  const std::vector<HoldFolder> holds = FindHolds(options.holds, options);
  const std::string page = options.out + "/index.html";
  int worst = kDone;
  std::vector<report::GalleryEntry> entries;
  std::vector<std::vector<io::Image>> overview;
  for (const HoldFolder& hold : holds) {
    fmt::print("{:<24}", hold.name);
    std::fflush(stdout);
    const int code = RunRetarget(hold.run);
    if (code == kInterrupted) return code;
    worst = std::max(worst, code);
    report::GalleryEntry entry{hold.name, TextOf(hold), report::ReadReport(hold.run.out)};
    const io::Image strip = report::ContactSheet(
        hold.run.out, {{0.02, 35}, {0.5, 35}, {0.5, 215}, {0.98, 35}}, true, 300, 340);
    io::WriteFile(hold.run.out + "/strip.png", io::EncodePng(strip), true);
    if (entries.size() % kOverviewColumns == 0) overview.emplace_back();
    overview.back().push_back(report::SolvedPicture(
        hold.run.out, {0.5, 35}, report::Humanize(hold.name), kPicture, kPicture));
    fmt::print("{}\n", report::GalleryLine(entry.report));
    entries.push_back(std::move(entry));
  }
  io::OutputSet output(options.out, {"index.html", "overview.png"}, {}, true);
  output.Add("overview.png", io::EncodePng(io::TileImages(overview)));
  output.Add("index.html", report::FormatGallery(entries));
  output.Commit();
  fmt::print("written to {}\n", page);
  return worst;
}

}  // namespace retarget::cli
