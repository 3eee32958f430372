#include "tools/cli/command_spec.h"

#include <CLI/CLI.hpp>

namespace retarget::cli {
namespace {

// CLI11 says "TEXT:{y,z}" of an option with a list of values.
std::vector<std::string> ChoicesIn(const std::string& type) {
  const size_t open = type.find('{'), close = type.rfind('}');
  std::vector<std::string> choices;
  if (open == std::string::npos || close == std::string::npos || close < open) return choices;
  std::istringstream list(type.substr(open + 1, close - open - 1));
  for (std::string choice; std::getline(list, choice, ',');) choices.push_back(choice);
  return choices;
}

OptionSpec SpecOf(const CLI::Option& option) {
  OptionSpec spec;
  for (const std::string& name : option.get_snames()) spec.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) spec.names.push_back("--" + name);
  spec.help = option.get_description();
  if (option.get_expected_min() == 0) return spec;
  const std::string type = option.get_type_name();
  spec.value = type.substr(0, type.find(':'));
  spec.choices = ChoicesIn(type);
  return spec;
}

}  // namespace

CommandSpec SpecOf(const CLI::App& app) {
  CommandSpec spec{app.get_name(), app.get_description(), {}, {}};
  for (const CLI::Option* option : app.get_options()) spec.options.push_back(SpecOf(*option));
  for (const CLI::App* command : app.get_subcommands({})) spec.commands.push_back(SpecOf(*command));
  return spec;
}

}  // namespace retarget::cli
