// The commands of the program: each reads, does, prints, and returns the exit code of the contract
// (0 done, 3 a requirement is missed, 4 a limit was hit, 130 interrupted). Bad input is thrown as
// InputError (exit code 2).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "io/files.h"
#include "io/load_clip.h"
#include "model/body/template_posture.h"
#include "tools/api/retarget.h"
#include "tools/cli/command_spec.h"

namespace retarget::cli {

enum ExitCode {
  kDone = 0,
  kInternal = 1,
  kBadInput = 2,
  kMissed = 3,
  kLimit = 4,
  kInterrupted = 130
};

// Where settings come from: a file, and single ones over it.
struct SettingsOptions {
  std::string config_path;       // empty: the defaults
  std::vector<std::string> set;  // "key=value"
};
Settings SettingsOf(const SettingsOptions& options);  // throws InputError

struct RetargetOptions {
  std::array<io::ClipOptions, 2> clip;
  std::string template_path, config_path, out = "out", frames;
  std::vector<std::string> set;
  std::string show = "figures";   // of scene.glb: "figures" or "characters"
  std::string rest = "keep";      // of what is written as BVH: "keep" or "t-pose"
  std::vector<std::string> also;  // "npz", "csv"
  double fps = 30, template_at = 0;
  int threads = -1;                // -1: as configured
  std::string progress = "table";  // on stderr: "table" (on a terminal only), or "json" lines
  bool json = false, force = false;
  bool page = true;    // report.html
  bool quiet = false;  // says nothing of the result
};
// As a request to the library: settings from the configuration file, then --set, then --threads.
// Throws InputError.
Request RequestOf(const RetargetOptions& options);

// What the program calls the options of a clip.
io::OptionWords ProgramWords();
// A refusal to write, with the options that help.
std::string WriteRefusalText(const io::WriteRefusal& refusal);

int RunRetarget(const RetargetOptions& options);

// Runs the forward simulation alone and writes baseline.glb and source.glb.
int RunSimulate(const RetargetOptions& options);

// Of a run's folder: every metric again, and the proof; `samples` judges by instants alone.
int RunVerify(const std::string& folder, bool samples, bool json);
// Two figures of any program against a template.
struct VerifySceneOptions {
  std::vector<std::string> scene;  // one file with both figures, or one for each
  std::string template_path;
  std::array<io::ClipOptions, 2> clip;  // what is read of each figure; without paths
  SettingsOptions settings;
};
int RunVerifyScene(const VerifySceneOptions& options, bool json);
// The certificate of a run's folder, by the second checker; what differs between two.
int RunCertificateCheck(const std::string& folder, bool json);
int RunCertificateDiff(const std::array<std::string, 2>& folders);
int RunCompare(const std::vector<std::string>& folders, bool json);
int RunTangles(const std::string& path, const SettingsOptions& settings, bool json);
int RunMap(const io::ClipOptions& clip, bool json, bool yaml);
// The clip with left and right exchanged.
int RunMirror(const io::ClipOptions& options, const std::string& out, bool force);
// What is in a motion or character file of any format.
int RunInspect(const io::ClipOptions& clip, bool json);
int RunConfig(const SettingsOptions& settings);
int RunTemplateCheck(const std::string& path, const SettingsOptions& settings, bool json);

struct FromClipsOptions {
  std::array<io::ClipOptions, 2> clip;
  int frame = 0;  // of both clips, from 0
  std::string out, name;
  bool force = false;
};
int RunTemplateFromClips(const FromClipsOptions& options);

TemplatePosture PostureFromClips(const FromClipsOptions& options);

// `retarget pose`: what to start from, then operations in the order of the command line.
struct PoseCommandOptions {
  std::string template_path;  // empty: T-poses, or two clips
  std::optional<FromClipsOptions> from_clips;
  struct Step {
    std::string name, value;  // of the option, without dashes
  };
  std::vector<Step> steps;
  std::string out;
  SettingsOptions settings;
  bool json = false, force = false;
};
int RunPose(const PoseCommandOptions& options);
// Runs every hold of the folders (template.yaml, clips a and b) with default settings into a folder
// each, and writes an index page. The worst exit code of all.
struct GalleryOptions {
  std::vector<std::string> holds;  // folders of holds, or holds
  std::string out = "gallery", config_path;
  std::vector<std::string> set;
  int threads = -1;
  bool force = false;
};
int RunGallery(const GalleryOptions& options);

// `retarget batch`: many pairs of a manifest or of two patterns.
struct BatchOptions {
  std::string manifest;                // path
  std::array<std::string, 2> pairs;    // instead: patterns of clips
  std::string pairing = "all";         // of them: "all" or "name"
  std::vector<std::string> templates;  // of them
  std::vector<std::string> with;       // "column=value" for every row
  std::string out, shard, memory;      // empty: none, the Slurm task's, what is free
  int processes = 0;                   // 0: one for each processor
  bool resume = false, force = false, merge = false, pictures = true, json = false;
};
// `columns`: the options of the program that a manifest may give. 0: all are met; 3: not all.
int RunBatch(const BatchOptions& options, const std::vector<OptionSpec>& columns);

// `retarget studio`: serves the posing page until it is interrupted.
struct StudioOptions {
  std::string template_path, photo_path;  // to begin with; empty: none
  std::string library;                    // folder; empty: the shipped one and the user's own
  std::array<io::ClipOptions, 2> clip;    // to try a posture on
  SettingsOptions settings;               // of its queries
  int port = 0;                           // 0: any that is free
  bool browser = true;                    // open the page
};
int RunStudio(const StudioOptions& options);

// Of a run's folder, or of a template's file.
int RunRender(const std::string& path, const std::string& out, bool force);

// To stderr, a line each, from the `from`-th on.
void PrintNotes(const std::vector<std::string>& notes, size_t from);

// Ctrl-C from here on: finish the iteration, write the best so far.
void CatchInterrupts();

}  // namespace retarget::cli
