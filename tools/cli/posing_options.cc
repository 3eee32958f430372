// Options of the commands that make postures: template, pose, studio.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>

#include "tools/cli/command_line.h"
#include "tools/posing/command_line.h"

namespace retarget::cli {
namespace {

// What was given of the posing options, in the order of the command line.
std::vector<PoseCommandOptions::Step> StepsInOrder(const CLI::App& posing) {
  std::vector<PoseCommandOptions::Step> steps;
  std::map<const CLI::Option*, size_t> used;
  for (const CLI::Option* option : posing.parse_order()) {
    if (option->get_group() != "Operations") continue;
    const bool flag = option->get_expected_min() == 0;
    const std::string value = flag ? "" : option->results().at(used[option]++);
    steps.push_back({option->get_lnames().front(), value});
  }
  return steps;
}

}  // namespace

void CommandLine::AddTemplate(CLI::App* app) {
  CLI::App* posture = app->add_subcommand("template", "make or check a template posture");
  posture->add_option("--check", check, "verify this template (YAML)");
  posture->add_option("--from-clips", clips, "two clips that share a world")->expected(2);
  posture->add_option("--frame", from_clips.frame, "frame of both clips, from 0");
  posture->add_option("--out", from_clips.out, "template to write (YAML)");
  posture->add_option("--name", from_clips.name, "name of the new template")
      ->default_str("from clips");
  posture->add_flag("--force", from_clips.force, "overwrite the file");
  posture->add_flag("--json", json);
  AddSettings(posture, &settings);
  AddClipOptions(posture, &from_clips.clip[0], "a", false);
  AddClipOptions(posture, &from_clips.clip[1], "b", false);
  posture->callback([this] { code = RunTemplate(); });
}

int CommandLine::RunTemplate() {
  if (!check.empty() && clips.empty()) return RunTemplateCheck(check, settings, json);
  if (!check.empty() || clips.empty() || from_clips.out.empty()) {
    throw InputError("template: expected --check FILE, or --from-clips A B --frame K --out FILE");
  }
  for (int f = 0; f < 2; ++f) from_clips.clip[f].path = clips[f];
  if (from_clips.name.empty()) from_clips.name = "from clips";
  return RunTemplateFromClips(from_clips);
}

void CommandLine::AddPose(CLI::App* app) {
  CLI::App* posing = app->add_subcommand(
      "pose", "pose two figures: operations one after the other, as given (docs/pose.md)");
  CLI::Option* start =
      posing->add_option("file", pose.template_path, "template to start from (YAML)");
  CLI::Option* rest =
      posing->add_flag("--rest")->description("start from two T-poses")->excludes(start);
  posing->add_option("--from-clips", clips, "start from two clips that share a world")
      ->expected(2)
      ->excludes(start)
      ->excludes(rest);
  posing->add_option("--frame", from_clips.frame, "frame of both clips, from 0");
  posing->add_option("--out", pose.out, "template to write (YAML)");
  posing->add_flag("--json", pose.json, "print tangles, overlaps and warnings as JSON");
  posing->add_flag("--force", pose.force, "overwrite the file");
  AddSettings(posing, &pose.settings);
  AddClipOptions(posing, &from_clips.clip[0], "a", false);
  AddClipOptions(posing, &from_clips.clip[1], "b", false);
  for (const posing::PoseWord& word : posing::PoseWords()) {
    const std::string name = "--" + word.name + (word.alias.empty() ? "" : ",--" + word.alias);
    CLI::Option* option = !word.value.empty()
                              ? posing->add_option(name)->type_name(word.value)->type_size(1)
                              : posing->add_flag(name);
    option->description(word.help)->group("Operations");
    option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  }
  posing->callback([this, posing, rest] {
    if (pose.template_path.empty() && clips.empty() && !rest->count()) {
      throw InputError("pose: expected a template, --rest or --from-clips A B");
    }
    if (!clips.empty()) {
      for (int f = 0; f < 2; ++f) from_clips.clip[f].path = clips[f];
      from_clips.name = "from clips";
      pose.from_clips = from_clips;
    }
    pose.steps = StepsInOrder(*posing);
    code = RunPose(pose);
  });
}

void CommandLine::AddStudio(CLI::App* app) {
  CLI::App* page =
      app->add_subcommand("studio", "pose two figures on a page in the browser (docs/studio.md)");
  page->add_option("--template", studio.template_path, "template to open (YAML)");
  page->add_option("--photo", studio.photo_path, "picture to pose over (PNG, JPEG, WebP)");
  page->add_option("--library", studio.library,
                   "folder of templates (default: the shipped ones and your own)");
  page->add_option("--clip-a", studio.clip[0].path, "clip to try the posture on");
  page->add_option("--clip-b", studio.clip[1].path, "clip to try the posture on");
  AddSettings(page, &studio.settings);
  page->add_option("--port", studio.port, "of 127.0.0.1; 0: any that is free")
      ->check(CLI::Range(0, 65535));
  page->add_flag("--no-browser,--print-url")->description("print the address only");
  AddClipOptions(page, &studio.clip[0], "a", false);
  AddClipOptions(page, &studio.clip[1], "b", false);
  page->callback([this, page] {
    studio.browser = page->count("--no-browser") == 0;
    code = RunStudio(studio);
  });
}

}  // namespace retarget::cli
