#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace regrasp::apps {

/// What is said of an option.
struct OptionHelp {
  std::string name;     ///< "--object"
  std::string type;     ///< "FILE", "imitate|slide"; empty for a flag
  std::string text;     ///< what it does, with unit and default
  std::string summary;  ///< its first clause, which shells show beside the name
  bool required = false;
  std::vector<std::string> choices;  ///< where it takes one of some words
};

struct HelpGroup {
  std::string name;
  std::vector<OptionHelp> options;
};

/// Of the options that all programs have; CLI11 puts --help there. It comes last in all texts.
inline constexpr char kGeneralGroup[] = "Options";

/// Options that are added from here on belong to a group of this name.
void BeginGroup(CLI::App& app, const std::string& name);

/// All options in their groups, in the order in which they were added.
[[nodiscard]] std::vector<HelpGroup> HelpGroups(const CLI::App& app);

/// The subcommands of `regrasp`; other programs have none.
[[nodiscard]] std::vector<const CLI::App*> Subcommands(const CLI::App& app);

/// "plan --object FILE --start FILE|random [options]", "regrasp COMMAND [options]".
[[nodiscard]] std::string UsageText(const CLI::App& app);

/// What --help prints: usage, what the program does, its subcommands, the options by groups, and
/// the examples (the app's footer). Lines are no longer than `width` characters where words are
/// not.
[[nodiscard]] std::string HelpText(const CLI::App& app, int width);

/// How wide text on standard output may be: COLUMNS, or what the terminal says, otherwise 80.
[[nodiscard]] int HelpWidth();

/// Break text into lines of at most `width` characters, each indented by `indent` spaces; ends with
/// a newline.
[[nodiscard]] std::string WrapText(const std::string& text, int indent, int width);

/// What makes the manual page and the completions of the shells from the same options; `format` is
/// "man", "bash", "zsh", "fish" or "markdown".
/// @throws InputError  another format.
[[nodiscard]] std::string FormatHelpAs(std::string_view format, const CLI::App& app);

/// The same for each of them.
[[nodiscard]] std::string ManPage(const CLI::App& app);
[[nodiscard]] std::string BashCompletion(const CLI::App& app);
[[nodiscard]] std::string ZshCompletion(const CLI::App& app);
[[nodiscard]] std::string FishCompletion(const CLI::App& app);
[[nodiscard]] std::string MarkdownHelp(const CLI::App& app);

}  // namespace regrasp::apps
