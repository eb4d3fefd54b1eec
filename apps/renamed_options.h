#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace regrasp::apps {

/// Return whether a word of the command line is an option.
/// Negative numbers and "-", the standard stream, are not options.
[[nodiscard]] bool IsOption(std::string_view word);

/// Command line with the current names of all options.
struct RenamedWords {
  std::vector<std::string> words;
  /// One note per old name: "--faces 500 is now --repair max-triangles=500".
  std::vector<std::string> notes;
};

/// Replace old names of options by the current ones.
/// Old names are accepted for one version.
/// @param program  name of the program: "plan".
/// @param words  command line without the program's name.
/// @throws InputError  if an old option has no equivalent in the current ones.
[[nodiscard]] RenamedWords RenameOptions(std::string_view program,
                                         const std::vector<std::string>& words);

}  // namespace regrasp::apps
