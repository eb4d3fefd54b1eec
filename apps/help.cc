#include "apps/help.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <functional>
#include <map>
#include <optional>
#include <sstream>

#include "apps/terminal_text.h"
#include "planner/base/error.h"
#include "planner/base/number.h"

namespace regrasp::apps {

namespace {

/// Column of an option's text in --help.
constexpr int kTextColumn = 26;
/// Column of an option's text in -h, and the length of the longest default in it.
constexpr int kShortColumn = 32, kLongestShortDefault = 24;

int Length(std::string_view utf8) {
  return static_cast<int>(
      std::ranges::count_if(utf8, [](char c) { return (c & '\xC0') != '\x80'; }));
}

/// Break words into lines of at most `width` characters.
/// Each line is indented by `indent` spaces.
std::string Wrap(const std::string& text, int indent, int width) {
  std::string lines, line;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!line.empty() && indent + Length(line) + 1 + Length(word) > width) {
      lines += std::string(indent, ' ') + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return lines + std::string(indent, ' ') + line + "\n";
}

/// Wrap each line of a text.
std::string WrapLines(const std::string& text, int indent, int width) {
  std::string lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines += Wrap(line, indent, width);
  return lines;
}

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

bool IsWord(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](unsigned char c) {
    return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '-';
  });
}

/// Return the words that a type lists as choices.
/// It has the form "FILE|random|random-any", CLI11's "FORMAT:{svg,pdf}" or
/// "points|hand[,KEY=VALUE]".
std::vector<std::string> ChoicesOf(const std::string& whole) {
  const std::string type = whole.substr(0, whole.find('['));
  const std::size_t brace = type.find(":{");
  std::vector<std::string> choices =
      brace == std::string::npos ? Split(type, '|')
                                 : Split(type.substr(brace + 2, type.find('}') - brace - 2), ',');
  if (brace == std::string::npos && choices.size() < 2) return {};
  std::erase_if(choices, [](const std::string& word) { return !IsWord(word); });
  return choices;
}

constexpr char kDefault[] = " [default: ";

/// Return the text up to the first stop or the default.
std::string FirstClause(const std::string& text) {
  std::size_t end = text.size();
  for (const char* stop : {"; ", ": ", ". ", ".\n", "\n", kDefault})
    end = std::min(end, text.find(stop));
  return text.substr(0, end);
}

/// Return "[default: 0.01]" in the first line of a text; empty if there is none. Further lines are
/// about the settings of a list.
std::string DefaultIn(const std::string& whole) {
  const std::string text = whole.substr(0, whole.find('\n'));
  const std::size_t begin = text.find(kDefault);
  if (begin == std::string::npos) return "";
  return text.substr(begin + 1, text.find(']', begin) - begin);
}

/// Suffix of a group's name for its rare options.
constexpr char kRare[] = " (rare)";

bool IsRare(const CLI::Option& option) { return option.get_group().ends_with(kRare); }

std::string GroupOf(const CLI::Option& option) {
  const std::string& group = option.get_group();
  return IsRare(option) ? group.substr(0, group.size() - std::string_view(kRare).size()) : group;
}

/// Return the usage texts without the program's name (SetUsage).
std::map<const CLI::App*, std::string>& Usages() {
  static std::map<const CLI::App*, std::string> usages;
  return usages;
}

OptionHelp HelpOf(const CLI::Option& option) {
  OptionHelp help;
  help.name = "--" + option.get_lnames().front();
  if (!option.get_snames().empty()) help.short_name = "-" + option.get_snames().front();
  const bool flag = option.get_items_expected_max() == 0;
  const std::string type = flag ? "" : option.get_type_name();
  help.type = type.substr(0, type.find(':'));
  help.choices = ChoicesOf(type);
  help.text = option.get_description();
  help.summary = FirstClause(help.text);
  help.usual = DefaultIn(help.text);
  help.required = option.get_required();
  help.value_optional = !flag && option.get_items_expected_min() == 0;
  help.rare = IsRare(option);
  return help;
}

std::string HeadOf(const OptionHelp& option) {
  return option.name + (option.type.empty() ? "" : " " + option.type);
}

/// Return the line of an option in -h. A type that is too long is cut.
std::string ShortLine(const OptionHelp& option) {
  std::string head = "  " + NamesOf(option);
  if (Length(head) > kShortColumn - 2) {
    const std::string names = head.substr(0, head.size() - option.type.size());
    const int room = kShortColumn - 3 - Length(names);
    head = names + (room > 0 ? option.type.substr(0, static_cast<std::size_t>(room)) : "") + "…";
  }
  head += std::string(static_cast<std::size_t>(std::max(2, kShortColumn - Length(head))), ' ');
  return head + option.summary + (option.required ? " (required)" : "") +
         (option.usual.empty() || Length(option.usual) > kLongestShortDefault
              ? ""
              : " " + option.usual) +
         "\n";
}

/// Break a list of choices into lines after a "|".
std::string BreakChoices(const std::string& head, int width) {
  if (Length(head) <= width) return head;
  const std::size_t end = head.rfind('|', static_cast<std::size_t>(width) - 1);
  if (end == std::string::npos) return head;
  return head.substr(0, end + 1) + "\n" + BreakChoices("      " + head.substr(end + 1), width);
}

/// Format a name with its text next to it, or below it if the name is long.
std::string DescribeEntry(const std::string& name, const std::string& what, int width) {
  const std::string head = "  " + name;
  const std::string text = WrapLines(what, kTextColumn, width);
  if (Length(head) + 2 > kTextColumn) return BreakChoices(head, width) + "\n" + text;
  return head + text.substr(Length(head));
}

std::string DescribeOption(const OptionHelp& option, int width) {
  return DescribeEntry(NamesOf(option), option.text + (option.required ? " (required)" : ""),
                       width);
}

std::string DescribeSubcommands(const CLI::App& app, int width) {
  std::string text;
  for (const CLI::App* command : Subcommands(app)) {
    text += DescribeEntry(command->get_name(), command->get_description(), width);
  }
  return text.empty() ? "" : "\nCommands:\n" + text;
}

}  // namespace

void BeginGroup(CLI::App& app, const std::string& name) { app.option_defaults()->group(name); }

std::string NamesOf(const OptionHelp& option) {
  return (option.short_name.empty() ? "" : option.short_name + ", ") + HeadOf(option);
}

void MarkRare(CLI::Option* option) {
  if (!IsRare(*option)) option->group(option->get_group() + kRare);
}

void MarkRare(CLI::App& app, const std::vector<std::string>& names) {
  for (const std::string& name : names) MarkRare(app.get_option(name));
}

void SetUsage(const CLI::App& app, const std::string& usage) { Usages()[&app] = usage; }

std::vector<HelpGroup> HelpGroups(const CLI::App& app) {
  std::vector<HelpGroup> groups;
  HelpGroup others{kGeneralTitle, {}};
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = GroupOf(*option);
    if (name.empty() || option->get_lnames().empty()) continue;
    if (name == kGeneralGroup) {
      others.options.push_back(HelpOf(*option));
      continue;
    }
    const auto known = std::ranges::find(groups, name, &HelpGroup::name);
    HelpGroup& group = known == groups.end() ? groups.emplace_back(HelpGroup{name, {}}) : *known;
    group.options.push_back(HelpOf(*option));
  }
  groups.push_back(std::move(others));
  return groups;
}

std::vector<const CLI::App*> Subcommands(const CLI::App& app) {
  return app.get_subcommands(std::function<bool(const CLI::App*)>());
}

std::string UsageText(const CLI::App& app) {
  std::string usage = app.get_name() + (Subcommands(app).empty() ? "" : " COMMAND");
  if (Usages().contains(&app)) return usage + " " + Usages()[&app] + " [options]";
  for (const HelpGroup& group : HelpGroups(app)) {
    for (const OptionHelp& option : group.options) {
      if (option.required) usage += " " + HeadOf(option);
    }
  }
  return usage + " [options]";
}

std::string HelpText(const CLI::App& app, int width, HelpLevel level) {
  std::string text = Wrap(app.get_description(), 0, width) + "\nUsage:\n" +
                     Wrap(UsageText(app), 2, width) + DescribeSubcommands(app, width);
  int hidden = 0;
  for (const HelpGroup& group : HelpGroups(app)) {
    std::string options;
    for (const OptionHelp& option : group.options) {
      const bool shown = !option.rare || level == HelpLevel::kAll;
      hidden += shown ? 0 : 1;
      if (!shown) continue;
      options += level == HelpLevel::kShort ? ShortLine(option) : DescribeOption(option, width);
    }
    if (!options.empty()) text += "\n" + group.name + ":\n" + options;
  }
  if (hidden > 0) {
    text += "\n" + Wrap("--help-all also lists " + std::to_string(hidden) +
                            (hidden > 1 ? " rare options." : " rare option."),
                        0, width);
  }
  const std::string examples = level == HelpLevel::kShort ? "" : app.get_footer();
  return text + (examples.empty() ? "" : "\nExamples:\n" + examples);
}

int HelpWidth() { return TextWidth(STDOUT_FILENO); }

std::string WrapText(const std::string& text, int indent, int width) {
  return Wrap(text, indent, width);
}

std::string FormatHelpAs(std::string_view format, const CLI::App& app) {
  if (format == "man") return ManPage(app);
  if (format == "bash") return BashCompletion(app);
  if (format == "zsh") return ZshCompletion(app);
  if (format == "fish") return FishCompletion(app);
  if (format == "markdown") return MarkdownHelp(app);
  throw InputError("--help-as: expected man, bash, zsh, fish or markdown, found \"" +
                   std::string(format) + "\"");
}

}  // namespace regrasp::apps
