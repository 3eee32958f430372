#include "tools/cli/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "tools/api/version.h"
#include "tools/cli/command_spec.h"
#include "tools/studio/paths.h"

namespace retarget::cli {

void AddClipOptions(CLI::App* app, io::ClipOptions* clip, const std::string& figure, bool solve) {
  const std::string suffix = figure.empty() ? "" : "-" + figure;
  const std::string group = figure.empty() ? "Options" : "Clip " + figure;
  clip->option = figure;
  clip->words = ProgramWords();
  app->add_option("--units" + suffix, clip->units,
                  "cm, m, mm, dm, in, cmu or metres per unit (default: guess)")
      ->group(group);
  app->add_option("--stature" + suffix, clip->stature,
                  solve ? "the motion on a body of this height (m); settles an unknown unit"
                        : "height of the figure (m): settles an unknown unit")
      ->check(CLI::Range(0.5, 3.0))
      ->group(group);
  app->add_option("--up" + suffix, clip->up, "up axis (default: from the motion)")
      ->check(CLI::IsMember({"y", "z"}))
      ->group(group);
  app->add_option("--amc-fps" + suffix, clip->amc_fps, "rate of an Acclaim motion (120)")
      ->check(CLI::Range(1.0, 1000.0))
      ->group(group);
  app->add_option("--map" + suffix, clip->map, "joint map (YAML; see `retarget map --yaml`)")
      ->group(group);
  app->add_option("--skip-frames" + suffix, clip->skip_frames, "drop frames from the beginning")
      ->check(CLI::NonNegativeNumber)
      ->group(group);
  app->add_option("--ik-targets" + suffix, clip->ik_targets,
                  "what targets of inverse kinematics do: follow their limbs, or keep")
      ->capture_default_str()
      ->check(CLI::IsMember({"follow", "keep"}))
      ->group(group);
  app->add_flag("--repair" + suffix, clip->repair_jumps,
                "interpolate frames that stand apart from the motion (see `retarget map`)")
      ->group(group);
  if (!solve) return;
  app->add_option("--character" + suffix, clip->character,
                  "put the motion on this character (glTF, VRM, BVH) and solve on its body")
      ->group(group);
  app->add_option("--character-map" + suffix, clip->character_map, "joint map of the character")
      ->group(group);
  app->add_option_function<std::string>(
         "--travel" + suffix,
         [clip](const std::string& what) { clip->keep_in_place = what == "keep"; },
         "a clip that strides in place: recover its way from the standing foot, or keep it")
      ->check(CLI::IsMember({"recover", "keep"}))
      ->default_str("recover")
      ->group(group);
  app->add_option("--start" + suffix, clip->start, "seconds into the clip")
      ->check(CLI::NonNegativeNumber)
      ->group(group);
}

void AddSettings(CLI::App* app, SettingsOptions* settings) {
  app->add_option("--config", settings->config_path, "weights and settings (YAML)");
  app->add_option("--set", settings->set, "one setting, such as tangle.max_tags=3 (repeatable)");
}

void CommandLine::Build(CLI::App* app) {
  app->set_version_flag("--version", api::kGenerator);
  app->require_subcommand(0, 1);
  AddRetarget(app);
  AddTools(app);
  AddTemplate(app);
  AddPose(app);
  AddStudio(app);
  AddBatch(app);
  AddCompletion(app);
}

void CommandLine::AddCompletion(CLI::App* app) {
  CLI::App* completion = app->add_subcommand(
      "completion", "a completion script for a shell, or the manual page, on stdout");
  completion->add_option("kind", file, "bash, zsh, fish or man")
      ->required()
      ->check(CLI::IsMember(kCompletionKinds));
  completion->callback([this, app] {
    fmt::print("{}", FormatCompletion(SpecOf(*app), file));
    code = kDone;
  });
}

void CommandLine::AddRetarget(CLI::App* app) {
  AddScene(app);
  app->add_flag("!--no-page", retarget.page, "no report.html");
  app->add_option("--also", retarget.also,
                  "more files of the scene, with commas between: npz (arrays for numpy), csv")
      ->delimiter(',')
      ->allow_extra_args(false);
  CLI::App* simulate = app->add_subcommand(
      "simulate", "the forward simulation alone: what `retarget` is compared with");
  AddScene(simulate);
  simulate->callback([this] {
    RequireScene();
    code = RunSimulate(retarget);
  });
}

// The options that say which clips are to be tangled how.
void CommandLine::AddScene(CLI::App* app) {
  RetargetOptions& o = retarget;
  app->add_option(
      "--clip-a", o.clip[0].path,
      "first clip: BVH (pair.bvh#figure=1), glTF (hero.glb#animation=Walk,skin=1), VRM, VRMA, or "
      "SKELETON.asf:CLIP.amc");
  app->add_option("--clip-b", o.clip[1].path, "second clip");
  app->add_option("--template", o.template_path, "template posture (YAML)");
  app->add_option("--config", o.config_path, "weights and settings (YAML; see `retarget config`)");
  app->add_option("--set", o.set, "one setting, such as weights.tangle=20 (repeatable)");
  app->add_option("--out", o.out, "folder for the results")->capture_default_str();
  app->add_option("--frames", o.frames, "output frames i:j, half-open, counted from the starts");
  app->add_option("--show", o.show, "scene.glb shows capsule figures, or the glTF characters")
      ->check(CLI::IsMember({"figures", "characters"}))
      ->capture_default_str();
  app->add_option("--rest", o.rest, "BVH as it begins, or with a T-pose before its first frame")
      ->check(CLI::IsMember({"keep", "t-pose"}))
      ->capture_default_str();
  app->add_option("--fps", o.fps, "output frame rate")
      ->check(CLI::Range(1.0, 1000.0))
      ->capture_default_str();
  app->add_option("--template-at", o.template_at,
                  "instant laid into the template, s from the starts")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app->add_option("--threads", o.threads, "0: all cores")->check(CLI::Range(0, 256));
  app->add_option("--progress", o.progress,
                  "of each iteration on stderr: a table (on terminals), or JSON, one per line")
      ->check(CLI::IsMember({"table", "json"}))
      ->capture_default_str();
  app->add_flag("--json", o.json, "print the report as JSON");
  app->add_flag("--force", o.force, "overwrite files that no earlier run wrote");
  AddClipOptions(app, &o.clip[0], "a", true);
  AddClipOptions(app, &o.clip[1], "b", true);
}

void CommandLine::AddTools(CLI::App* app) {
  AddProof(app);

  CLI::App* compare = app->add_subcommand("compare", "finished runs side by side");
  compare->add_option("folders", folders, "what --out was, one or more")->required();
  compare->add_flag("--json", json);
  compare->callback([this] { code = RunCompare(folders, json); });

  CLI::App* holds = app->add_subcommand("gallery", "run holds, and write a page that shows them");
  holds
      ->add_option("holds", gallery.holds,
                   "folders with template.yaml, a.bvh and b.bvh, or folders of such")
      ->default_str("the shipped holds");
  holds->add_option("--out", gallery.out, "folder for the page and the runs")
      ->capture_default_str();
  holds->add_option("--config", gallery.config_path, "weights and settings (YAML)");
  holds->add_option("--set", gallery.set, "one setting (repeatable)");
  holds->add_option("--threads", gallery.threads, "0: all cores")->check(CLI::Range(0, 256));
  holds->add_flag("--force", gallery.force, "overwrite files that no earlier run wrote");
  holds->callback([this] {
    if (gallery.holds.empty()) gallery.holds = {(studio::ShippedDataFolder() / "holds").string()};
    code = RunGallery(gallery);
  });

  CLI::App* tangles =
      app->add_subcommand("tangles", "what is tangled in a template or in node positions");
  tangles->add_option("file", file, "template (YAML) or positions (JSON)")->required();
  tangles->add_flag("--json", json);
  AddSettings(tangles, &settings);
  tangles->callback([this] { code = RunTangles(file, settings, json); });

  CLI::App* map = app->add_subcommand("map", "what is recognised in a clip");
  map->add_option("file", map_clip.path, "clip: BVH, glTF, VRM, or SKELETON.asf:CLIP.amc")
      ->required();
  AddClipOptions(map, &map_clip, "", false);
  CLI::Option* as_json = map->add_flag("--json", json);
  map->add_flag("--yaml", yaml, "print the map as a file to edit")->excludes(as_json);
  map->callback([this] {
    map_clip.any_animation = true;
    code = RunMap(map_clip, json, yaml);
  });

  CLI::App* mirror = app->add_subcommand("mirror", "a clip with left and right exchanged");
  mirror->add_option("file", map_clip.path, "clip: BVH, glTF, VRM, or SKELETON.asf:CLIP.amc")
      ->required();
  mirror->add_option("--out", picture, "file to write, in the clip's own format")->required();
  mirror->add_flag("--force", force, "overwrite the file");
  AddClipOptions(mirror, &map_clip, "", false);
  mirror->callback([this] { code = RunMirror(map_clip, picture, force); });

  CLI::App* inspect = app->add_subcommand("inspect", "what is in a motion or character file");
  inspect->add_option("file", map_clip.path, "BVH, glTF, VRM, or SKELETON.asf:CLIP.amc")
      ->required();
  inspect->add_flag("--json", json);
  inspect->callback([this] {
    map_clip.any_animation = true;
    code = RunInspect(map_clip, json);
  });

  CLI::App* configuration =
      app->add_subcommand("config", "every setting with default, unit and meaning, as YAML");
  configuration->add_option("--config", settings.config_path, "start from this file");
  configuration->add_option("--set", settings.set, "change one setting");
  configuration->callback([this] { code = RunConfig(settings); });

  CLI::App* render =
      app->add_subcommand("render", "a picture of a run (source above result) or of a template");
  render->add_option("path", folder, "what --out was, or a template (YAML)")->required();
  render->add_option("--out", picture,
                     "PNG file (default: scene.png in the folder; beside the template)");
  render->add_flag("--force", force, "overwrite the file");
  render->callback([this] {
    const bool run = std::filesystem::is_directory(folder);
    const std::string usual =
        run ? folder + "/scene.png"
            : std::filesystem::path(folder).replace_extension(".png").string();
    code = RunRender(folder, picture.empty() ? usual : picture, force || (run && picture.empty()));
  });
}

void CommandLine::AddProof(CLI::App* app) {
  CLI::App* verify = app->add_subcommand(
      "verify", "recompute all metrics from a run's files, and prove the motion for all t");
  CLI::Option* of_run = verify->add_option("folder", folder, "what --out was");
  verify
      ->add_option("--scene", verify_scene.scene,
                   "instead of a run: a scene of any program, one file or one per figure")
      ->excludes(of_run);
  verify->add_option("--template", verify_scene.template_path, "that --scene is proved against");
  AddSettings(verify, &verify_scene.settings);
  for (int f = 0; f < 2; ++f) {
    AddClipOptions(verify, &verify_scene.clip[f], f == 0 ? "a" : "b", false);
  }
  verify->add_flag("--samples", samples, "judge by frames and instants between them, no proof");
  verify->add_flag("--json", json);
  verify->callback([this] {
    if (!verify_scene.scene.empty()) {
      code = RunVerifyScene(verify_scene, json);
      return;
    }
    if (folder.empty()) throw InputError("verify: name a run's folder, or --scene and --template");
    code = RunVerify(folder, samples, json);
  });

  CLI::App* certificate =
      app->add_subcommand("certificate", "check the proof that a run wrote, or compare two");
  certificate->require_subcommand(1);
  CLI::App* again = certificate->add_subcommand(
      "check", "whether certificate.json holds, by another implementation than made it");
  again->add_option("folder", folder, "what --out was")->required();
  again->add_flag("--json", json);
  again->callback([this] { code = RunCertificateCheck(folder, json); });
  CLI::App* diff = certificate->add_subcommand("diff", "what differs between two certificates");
  diff->add_option("a", folder, "what --out was")->required();
  diff->add_option("b", other_folder, "what --out was, of the other")->required();
  diff->callback([this] { code = RunCertificateDiff({folder, other_folder}); });
}

void CommandLine::RequireScene() const {
  const std::pair<const char*, const std::string*> required[] = {
      {"--clip-a", &retarget.clip[0].path},
      {"--clip-b", &retarget.clip[1].path},
      {"--template", &retarget.template_path}};
  for (const auto& [name, value] : required) {
    if (value->empty()) throw InputError(fmt::format("{} is missing; see `retarget --help`", name));
  }
}

int CommandLine::RunMain() const {
  RequireScene();
  return RunRetarget(retarget);
}

}  // namespace retarget::cli
