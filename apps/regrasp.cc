// regrasp: provides all programs under one name, `regrasp plan` for `plan`. `regrasp help plan`
// prints its help.

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "apps/commands.h"
#include "apps/options.h"
#include "apps/program.h"
#include "planner/base/error.h"

namespace {

using namespace regrasp::apps;
using namespace regrasp;

constexpr char kProgram[] = "regrasp";

/// Check the name of a command.
/// @throws InputError  if there is no command of this name.
void CheckCommand(const std::string& name) {
  std::vector<std::string> names;
  for (const Command& command : kCommands) names.emplace_back(command.name);
  if (std::ranges::find(names, name) != names.end()) return;
  throw InputError("unknown command " + name + SimilarWord(name, names) +
                   " (regrasp --help lists all)");
}

/// Replace this process by a program in the same folder.
/// Exit codes, signals and streams are those of the program.
/// @param argv  arguments from the command on, with a null pointer at the end.
/// @throws EnvironmentError  if the program does not start.
[[noreturn]] void Become(const std::string& name, char** argv) {
  std::error_code unknown;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const std::string program = self.parent_path() / name;
  // The program prints the name by which it was called.
  std::string called = std::string(kProgram) + " " + name;
  argv[0] = called.data();
  execv(program.c_str(), argv);
  throw EnvironmentError(program + " cannot be started: " + std::strerror(errno));
}

/// Replace this process by the help of a command.
[[noreturn]] void ShowHelpOf(const std::string& name) {
  CheckCommand(name);
  std::string option = "--help";
  char* arguments[] = {nullptr, option.data(), nullptr};
  Become(name, arguments);
}

}  // namespace

int main(int argc, char** argv) {
  const bool is_help = argc > 1 && std::string_view(argv[1]) == "help";
  if (is_help && argc > 2) {
    return RunGuarded(kProgram, [argv]() -> int { ShowHelpOf(argv[2]); });
  }
  std::string help = "--help";
  if (is_help) argv[1] = help.data();
  if (argc > 1 && argv[1][0] != '-') {
    return RunGuarded(kProgram, [argv]() -> int {
      CheckCommand(argv[1]);
      Become(argv[1], argv + 1);
    });
  }
  CLI::App app("Plan how a hand changes its grasp on an object, and validate such plans.",
               kProgram);
  for (const Command& command : kCommands) app.add_subcommand(command.name, command.text);
  app.footer(
      "  regrasp help plan\n"
      "  regrasp validate --object cube.obj --plan plan.json\n");
  return RunProgram(app, argc, argv, []() -> int {
    throw InputError("a command is required (regrasp --help lists all)");
  });
}
