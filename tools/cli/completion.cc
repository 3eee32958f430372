// FormatCompletion of tools/cli/command_spec.h.
#include <fmt/format.h>

#include <algorithm>

#include "model/geometry/types.h"
#include "tools/cli/command_spec.h"

namespace retarget::cli {
namespace {

std::string Joined(const std::vector<std::string>& words, const std::string& between) {
  std::string joined;
  for (const std::string& word : words) joined += (joined.empty() ? "" : between) + word;
  return joined;
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

std::vector<std::string> NamesOf(const std::vector<OptionSpec>& options) {
  std::vector<std::string> names;
  for (const OptionSpec& option : options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

std::vector<std::string> CommandNames(const CommandSpec& program) {
  std::vector<std::string> names;
  for (const CommandSpec& command : program.commands) names.push_back(command.name);
  return names;
}

// Options of one command as the branch of a `case` over the word before the cursor.
std::string BashChoices(const CommandSpec& command) {
  std::string cases;
  for (const OptionSpec& option : command.options) {
    if (option.value.empty() || option.names.empty()) continue;
    cases += option.choices.empty()
                 ? fmt::format("      {}) return ;;\n", Joined(option.names, "|"))
                 : fmt::format("      {}) COMPREPLY=($(compgen -W '{}' -- \"$word\")); return ;;\n",
                               Joined(option.names, "|"), Joined(option.choices, " "));
  }
  return cases;
}

std::string Bash(const CommandSpec& program) {
  std::string branches;
  for (const CommandSpec& command : program.commands) {
    branches += fmt::format("    {})\n      words='{}'\n      case $before in\n{}      esac ;;\n",
                            command.name, Joined(NamesOf(command.options), " "),
                            Replaced(BashChoices(command), "      -", "        -"));
  }
  return fmt::format(
      "# bash completion of {0}. Values without a list of their own are file names.\n"
      "_{0}() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words\n"
      "  case ${{COMP_WORDS[1]}} in\n{1}    *)\n      words='{2}'\n"
      "      ((COMP_CWORD == 1)) && words=\"$words {3}\"\n      case $before in\n{4}      esac ;;\n"
      "  esac\n"
      "  [[ $word == -* || $COMP_CWORD == 1 ]] && COMPREPLY=($(compgen -W \"$words\" -- "
      "\"$word\"))\n"
      "}}\n"
      "complete -o default -F _{0} {0}\n",
      program.name, branches, Joined(NamesOf(program.options), " "),
      Joined(CommandNames(program), " "), Replaced(BashChoices(program), "      -", "        -"));
}

// A text between single quotes of zsh's _arguments.
std::string ZshText(const std::string& text) {
  std::string out;
  for (const char c : Replaced(text, "'", "'\\''")) {
    if (c == '[' || c == ']' || c == ':') out += '\\';
    out += c;
  }
  return out;
}

std::string ZshArguments(const CommandSpec& command, const std::string& indent) {
  std::string out;
  for (const OptionSpec& option : command.options) {
    const std::string value = option.value.empty()     ? ""
                              : option.choices.empty() ? ":" + ZshText(option.value) + ":_files"
                                                       : ":" + ZshText(option.value) + ":(" +
                                                             Joined(option.choices, " ") + ")";
    for (const std::string& name : option.names) {
      out += fmt::format(" \\\n{}'*{}[{}]{}'", indent, name, ZshText(option.help), value);
    }
  }
  return out + " \\\n" + indent + "'*:file:_files'";
}

std::string Zsh(const CommandSpec& program) {
  std::string commands, branches;
  for (const CommandSpec& command : program.commands) {
    commands += fmt::format("    '{}:{}'\n", command.name, ZshText(command.help));
    branches +=
        fmt::format("      {}) _arguments{} ;;\n", command.name, ZshArguments(command, "        "));
  }
  return fmt::format(
      "#compdef {0}\n_{0}() {{\n  local -a commands=(\n{1}  )\n"
      "  if ((CURRENT == 2)) && [[ $words[2] != -* ]]; then\n"
      "    _describe command commands\n    return\n  fi\n"
      "  case $words[2] in\n{2}      *) _arguments{3} ;;\n  esac\n}}\n_{0} \"$@\"\n",
      program.name, commands, branches, ZshArguments(program, "        "));
}

std::string FishText(const std::string& text) {
  return "'" + Replaced(Replaced(text, "\\", "\\\\"), "'", "\\'") + "'";
}

std::string FishOptions(const CommandSpec& command, const std::string& program,
                        const std::string& condition) {
  std::string out;
  for (const OptionSpec& option : command.options) {
    if (option.names.empty()) continue;
    out += fmt::format("complete -c {} -n '{}'", program, condition);
    for (const std::string& name : option.names) {
      out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    if (!option.value.empty()) out += " -r";
    if (!option.choices.empty()) out += " -f -a " + FishText(Joined(option.choices, " "));
    out += " -d " + FishText(option.help) + "\n";
  }
  return out;
}

std::string Fish(const CommandSpec& program) {
  std::string out = fmt::format("# fish completion of {}.\n", program.name);
  for (const CommandSpec& command : program.commands) {
    out += fmt::format("complete -c {} -n __fish_use_subcommand -a {} -d {}\n", program.name,
                       command.name, FishText(command.help));
    out += FishOptions(command, program.name, "__fish_seen_subcommand_from " + command.name);
  }
  return out + FishOptions(program, program.name, "__fish_use_subcommand");
}

// Text of a troff page: dashes as typed, no line that begins like a request.
std::string Troff(const std::string& text) {
  std::string out = Replaced(Replaced(text, "\\", "\\e"), "-", "\\-");
  if (out.starts_with(".") || out.starts_with("'")) out = "\\&" + out;
  return out;
}

std::string ManOptions(const CommandSpec& command) {
  std::string out;
  for (const OptionSpec& option : command.options) {
    const std::string value = option.choices.empty() ? option.value : Joined(option.choices, "|");
    const std::string names = option.names.empty() ? option.value : Joined(option.names, ", ");
    out += fmt::format(".TP\n.B {}{}\n{}\n", Troff(names),
                       option.names.empty() || value.empty() ? "" : " \\fI" + Troff(value) + "\\fR",
                       Troff(option.help));
  }
  return out;
}

std::string Man(const CommandSpec& program) {
  std::string out = fmt::format(
      ".TH {0} 1\n.SH NAME\n{1} \\- {2}\n.SH SYNOPSIS\n"
      ".B {1}\n\\-\\-clip\\-a A \\-\\-clip\\-b B \\-\\-template T.yaml [options]\n.br\n"
      ".B {1}\n\\fIcommand\\fR [options]\n.SH OPTIONS\n{3}.SH COMMANDS\n",
      "RETARGET", program.name, Troff(program.help), ManOptions(program));
  for (const CommandSpec& command : program.commands) {
    out += fmt::format(".SS {}\n{}\n{}", command.name, Troff(command.help), ManOptions(command));
  }
  return out +
         ".SH EXIT STATUS\n"
         ".TP\n.B 0\nsolved, every requirement verified\n"
         ".TP\n.B 1\ninternal error\n"
         ".TP\n.B 2\nbad usage, configuration or input\n"
         ".TP\n.B 3\nsolved and written, but a requirement is missed\n"
         ".TP\n.B 4\na limit was hit; the best result so far is written\n"
         ".TP\n.B 130\ninterrupted; the best result so far is written\n";
}

}  // namespace

std::string FormatCompletion(const CommandSpec& program, const std::string& kind) {
  if (kind == "bash") return Bash(program);
  if (kind == "zsh") return Zsh(program);
  if (kind == "fish") return Fish(program);
  if (kind == "man") return Man(program);
  throw InputError("completion " + kind + ": expected bash, zsh, fish or man");
}

}  // namespace retarget::cli
