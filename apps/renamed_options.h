#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace regrasp::apps {

/// Return true iff a word of the command line is an option: neither a negative number nor "-", the
/// standard stream.
[[nodiscard]] bool IsOption(std::string_view word);

/// Command line with the current names of all options.
struct RenamedWords {
  std::vector<std::string> words;
  /// One note per old name: "--faces 500 is now --repair max-triangles=500".
  std::vector<std::string> notes;
};

/// Replace old names of options, which are accepted for one version, by the current ones.
/// @param program  name of the program: "plan".
/// @param words  command line without the program's name.
/// @throws InputError  if an old option has no equivalent in the current ones.
[[nodiscard]] RenamedWords RenameOptions(std::string_view program,
                                         const std::vector<std::string>& words);

}  // namespace regrasp::apps
