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
    {"plan", "Finds a regrasp sequence from a start grasp to a goal grasp and writes a plan."},
    {"validate",
     "Checks plans or grasps analytically, replays them in MuJoCo, tests every static grasp with "
     "disturbances, and reports pass or fail."},
    {"graph", "Builds the switching graph of an object and prints its size."},
    {"figure", "Draws every step of a regrasp plan as a figure for a paper, and a sheet of all."},
    {"repair",
     "Makes a closed solid of a scan, a broken mesh or several shells, and reports the changes."},
    {"merge", "Joins the shards of a run over many plans into the file that one run writes."},
    {"evaluate",
     "Tests grasps of data sets on their own hand, with all of its links, analytically and in "
     "MuJoCo."},
    {"hand",
     "Finds palm, fingers and fingertips in a hand model, and prints joints, limits and reach."},
}};

/// Return the purpose of a program; empty for an unknown name.
[[nodiscard]] inline std::string CommandText(const std::string& name) {
  for (const Command& command : kCommands) {
    if (command.name == name) return command.text;
  }
  return "";
}

}  // namespace regrasp::apps
