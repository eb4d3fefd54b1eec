#pragma once

#include <array>
#include <string>

namespace regrasp::apps {

/// A program that is also a subcommand of `regrasp`.
struct Command {
  const char* name;
  const char* text;  ///< purpose of the program, one sentence
};

inline constexpr std::array<Command, 7> kCommands = {{
    {"plan", "Finds a regrasp sequence from a start grasp to a goal grasp and writes a plan."},
    {"validate",
     "Checks a regrasp plan, a library of plans or a single grasp analytically, replays it in "
     "MuJoCo with frictional point fingers, shakes the object at every rest state, and says pass "
     "or fail."},
    {"graph", "Builds the switching graph of an object and prints its size."},
    {"figure", "Draws every step of a regrasp plan as a figure for a paper, and a sheet of all."},
    {"repair",
     "Makes a solid of a scan, a broken mesh or several shells, and says what it changed."},
    {"merge", "Joins the shards of a run over many plans into the file that one run writes."},
    {"hand",
     "Finds palm, fingers and fingertips in a model of a hand, and prints what they can do."},
}};

/// Return the purpose of a program; empty for an unknown name.
[[nodiscard]] inline std::string CommandText(const std::string& name) {
  for (const Command& command : kCommands) {
    if (command.name == name) return command.text;
  }
  return "";
}

}  // namespace regrasp::apps
