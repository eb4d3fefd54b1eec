#pragma once

#include <array>
#include <string>

namespace regrasp::apps {

/// A program that is also a subcommand of `regrasp`.
struct Command {
  const char* name;
  const char* text;  ///< purpose of the program, one sentence
};

inline constexpr std::array<Command, 8> kCommands = {{
    {"plan", "Find a regrasp sequence from a start grasp to a goal grasp."},
    {"validate", "Check plans or grasps analytically and in simulation."},
    {"graph", "Build the switching graph of an object and print its size."},
    {"figure", "Draw each step of a plan as a figure, and a sheet of all steps."},
    {"repair", "Make a closed solid of a scan, a broken mesh or several shells."},
    {"merge", "Join the shards of a run over many plans into one file."},
    {"evaluate", "Test grasps of data sets on their own hand, analytically and in MuJoCo."},
    {"hand", "Find palm, fingers and fingertips of a hand model and write a hand file."},
}};

/// Return the purpose of a program; empty for an unknown name.
[[nodiscard]] inline std::string CommandText(const std::string& name) {
  for (const Command& command : kCommands) {
    if (command.name == name) return command.text;
  }
  return "";
}

}  // namespace regrasp::apps
