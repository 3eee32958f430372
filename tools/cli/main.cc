// The command line: options in, exit code out.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "tools/cli/command_line.h"
#include "tools/cli/commands.h"
#include "tools/studio/child_process.h"

int main(int argc, char** argv) {
  using namespace retarget;
  using namespace retarget::cli;
  studio::EndWithParentIfAsked();
  CLI::App app(
      "Two motions, each captured alone, become one scene of two people tangled with each other.",
      "retarget");
  CommandLine command;
  command.Build(&app);
  try {
    app.parse(argc, argv);
    return app.get_subcommands().empty() ? command.RunMain() : command.code;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    fmt::print(stderr, "retarget: {}; see `retarget --help`\n", error.what());
    return kBadInput;
  } catch (const io::WriteRefusal& refusal) {
    fmt::print(stderr, "retarget: {}\n", WriteRefusalText(refusal));
    return kBadInput;
  } catch (const InputError& error) {
    fmt::print(stderr, "retarget: {}\n", error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "retarget: internal error: {}\n", error.what());
    return kInternal;
  }
}
