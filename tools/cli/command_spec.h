// The commands and options of the program as plain values, and what shells and `man` read of them.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace retarget::cli {

struct OptionSpec {
  std::vector<std::string> names;  // with dashes; none: an argument without a name
  std::string help;
  std::string value;                 // what it takes ("TEXT"); empty: a flag
  std::vector<std::string> choices;  // all the values there are, where they are few
};

struct CommandSpec {
  std::string name, help;
  std::vector<OptionSpec> options;
  std::vector<CommandSpec> commands;
};

CommandSpec SpecOf(const CLI::App& app);

// A completion script ("bash", "zsh", "fish"), or the manual page ("man", troff).
std::string FormatCompletion(const CommandSpec& program, const std::string& kind);
inline const std::vector<std::string> kCompletionKinds = {"bash", "zsh", "fish", "man"};

}  // namespace retarget::cli
