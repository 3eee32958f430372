// The options of `retarget batch`.
#include <CLI/CLI.hpp>

#include "tools/cli/command_line.h"
#include "tools/cli/command_spec.h"

namespace retarget::cli {

void CommandLine::AddBatch(CLI::App* app) {
  BatchOptions& o = batch;
  CLI::App* sub = app->add_subcommand("batch", "many pairs: a manifest, a folder that resumes");
  CLI::Option* manifest =
      sub->add_option("manifest", o.manifest,
                      "CSV, JSON lines or YAML: id, clip_a, clip_b, template, options, settings");
  sub->add_option_function<std::vector<std::string>>(
         "--pairs",
         [this](const std::vector<std::string>& patterns) {
           batch.pairs = {patterns[0], patterns[1]};
         },
         "two patterns of clips ('a/*.bvh' 'b/*.bvh') instead of a manifest; without --out the "
         "manifest is printed")
      ->expected(2)
      ->excludes(manifest);
  sub->add_option("--pairing", o.pairing,
                  "of --pairs: every clip with every other, or those that are called the same")
      ->check(CLI::IsMember({"all", "name"}))
      ->capture_default_str();
  sub->add_option("--template", o.templates, "of --pairs: template posture (repeatable)");
  sub->add_option("--with", o.with,
                  "a column for rows that do not have it: weights.tangle=5,20 (repeatable)");
  sub->add_option("--out", o.out, "folder for the results, a folder each");
  CLI::Option* resume =
      sub->add_flag("--resume", o.resume, "go on: leave alone what is finished and unchanged");
  sub->add_option("--jobs", o.processes, "pairs at once (default: one for each processor)")
      ->check(CLI::Range(1, 1024));
  sub->add_option("--memory", o.memory,
                  "that all may take together, such as 8G (default: 80 % of what is free)");
  sub->add_option("--shard", o.shard,
                  "part i/n of the pairs, i from 0 (default: the task of a Slurm array)");
  sub->add_flag("--merge", o.merge, "run nothing: make one index of what all shards did");
  sub->add_flag("!--no-pictures", o.pictures, "no scene.png for each pair");
  sub->add_flag("--force", o.force, "start over, and overwrite folders that no run wrote")
      ->excludes(resume);
  sub->add_flag("--json", o.json, "print the summary as JSON");
  sub->callback([this, app] { code = RunBatch(batch, SpecOf(*app).options); });
}

}  // namespace retarget::cli
