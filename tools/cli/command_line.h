// The command line as CLI11 reads it: every command with its options, and the call that runs it.
#pragma once

#include <string>
#include <vector>

#include "tools/cli/commands.h"

namespace CLI {
class App;
}

namespace retarget::cli {

struct CommandLine {
  void Build(CLI::App* app);
  int RunMain() const;

  void AddCompletion(CLI::App* app);
  void AddRetarget(CLI::App* app);
  // The options that say which clips are to be tangled how.
  void AddScene(CLI::App* app);
  void AddTools(CLI::App* app);
  void AddProof(CLI::App* app);
  void AddTemplate(CLI::App* app);
  int RunTemplate();
  void AddPose(CLI::App* app);
  void AddStudio(CLI::App* app);
  void AddBatch(CLI::App* app);
  void RequireScene() const;

  RetargetOptions retarget;
  FromClipsOptions from_clips;
  PoseCommandOptions pose;
  GalleryOptions gallery;
  StudioOptions studio;
  BatchOptions batch;
  VerifySceneOptions verify_scene;
  io::ClipOptions map_clip;
  SettingsOptions settings;
  std::string folder, other_folder, file, check, picture;
  std::vector<std::string> clips, folders;
  bool json = false, yaml = false, force = false, samples = false;
  int code = 0;  // of the command that ran while parsing
};

// Options of one clip. The main command names them by figure, `retarget map` does not.
void AddClipOptions(CLI::App* app, io::ClipOptions* clip, const std::string& figure, bool solve);
void AddSettings(CLI::App* app, SettingsOptions* settings);

}  // namespace retarget::cli
