#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace regrasp::apps {

/// Help text of an option.
struct OptionHelp {
  std::string name;        ///< "--object"
  std::string short_name;  ///< "-o"; empty if there is none
  std::string type;        ///< "FILE", "points|hand"; empty for a flag
  std::string text;        ///< purpose, unit and default; then one line per setting
  std::string summary;     ///< first clause of the text, for `-h` and shells
  std::string usual;       ///< "[default: 0.01]", from the end of the text; can be empty
  bool required = false;
  bool value_optional = false;       ///< the option can be given without a value
  bool rare = false;                 ///< listed by --help-all only
  std::vector<std::string> choices;  ///< words among its values
};

/// Options that a help text lists, and their form.
enum class HelpLevel {
  kShort,  ///< -h: one line per option, no rare options
  kFull,   ///< --help: no rare options
  kAll,    ///< --help-all
};

struct HelpGroup {
  std::string name;
  std::vector<OptionHelp> options;
};

/// Group of the options that all programs have. It comes last in all texts.
/// CLI11 puts --help there.
inline constexpr char kGeneralGroup[] = "Options";

/// Title of that group.
inline constexpr char kGeneralTitle[] = "General";

/// Return "-o, --output FILE".
[[nodiscard]] std::string NamesOf(const OptionHelp& option);

/// Put the options that are added from here on into a group of this name.
void BeginGroup(CLI::App& app, const std::string& name);

/// Mark an option as rare: only --help-all lists it.
void MarkRare(CLI::Option* option);

/// Mark options of these names as rare.
void MarkRare(CLI::App& app, const std::vector<std::string>& names);

/// Set the part of the usage between the program's name and "[options]".
void SetUsage(const CLI::App& app, const std::string& usage);

/// Return all options in their groups, in the order in which they were added.
[[nodiscard]] std::vector<HelpGroup> HelpGroups(const CLI::App& app);

/// Return the subcommands of `regrasp`; empty for other programs.
[[nodiscard]] std::vector<const CLI::App*> Subcommands(const CLI::App& app);

/// Return the usage, such as "plan --object FILE --output FILE [options]".
/// It contains the text of SetUsage, or the required options if none is set.
[[nodiscard]] std::string UsageText(const CLI::App& app);

/// Return the text that -h, --help or --help-all prints.
/// It has the usage, the purpose, the subcommands and the options by groups. Except for -h, it also
/// has the examples (the app's footer). Lines have at most `width` characters, unless a single word
/// is longer. -h does not wrap the lines of options.
[[nodiscard]] std::string HelpText(const CLI::App& app, int width, HelpLevel level);

/// Return the width of text on standard output.
/// It is COLUMNS, or the width of the terminal, or 80.
[[nodiscard]] int HelpWidth();

/// Break text into lines of at most `width` characters.
/// Each line is indented by `indent` spaces. The result ends with a newline.
[[nodiscard]] std::string WrapText(const std::string& text, int indent, int width);

/// Return a document of the options in a format.
/// The formats are the manual page ("man"), shell completions ("bash", "zsh", "fish") and the
/// reference page ("markdown").
/// @throws InputError  if `format` is a different one.
[[nodiscard]] std::string FormatHelpAs(std::string_view format, const CLI::App& app);

/// Return the document of one format.
[[nodiscard]] std::string ManPage(const CLI::App& app);
[[nodiscard]] std::string BashCompletion(const CLI::App& app);
[[nodiscard]] std::string ZshCompletion(const CLI::App& app);
[[nodiscard]] std::string FishCompletion(const CLI::App& app);
[[nodiscard]] std::string MarkdownHelp(const CLI::App& app);

}  // namespace regrasp::apps
