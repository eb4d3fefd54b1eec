#include "apps/help.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <functional>
#include <optional>
#include <sstream>

#include "planner/base/error.h"
#include "planner/base/number.h"

namespace regrasp::apps {

namespace {

/// Of lines: narrower ones break every word, and wider ones are hard to read.
constexpr int kNarrowest = 40, kWidest = 120, kUsualWidth = 80;

/// Where the text of an option begins, and what is left of the line at least.
constexpr int kTextColumn = 26;

int Length(std::string_view utf8) {
  return static_cast<int>(
      std::ranges::count_if(utf8, [](char c) { return (c & '\xC0') != '\x80'; }));
}

/// Words in lines of at most `width` characters, each begun by `indent` spaces.
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

/// The words among "FILE|random|random-any", or of CLI11's "FORMAT:{svg,pdf}".
std::vector<std::string> ChoicesOf(const std::string& type) {
  const std::size_t brace = type.find(":{");
  std::vector<std::string> choices =
      brace == std::string::npos ? Split(type, '|')
                                 : Split(type.substr(brace + 2, type.find('}') - brace - 2), ',');
  if (brace == std::string::npos && choices.size() < 2) return {};
  std::erase_if(choices, [](const std::string& word) { return !IsWord(word); });
  return choices;
}

/// Up to the first stop, or the default.
std::string FirstClause(const std::string& text) {
  std::size_t end = text.size();
  for (const char* stop : {"; ", ": ", ". ", " (default"}) end = std::min(end, text.find(stop));
  return text.substr(0, end);
}

OptionHelp HelpOf(const CLI::Option& option) {
  OptionHelp help;
  help.name = "--" + option.get_lnames().front();
  const bool flag = option.get_items_expected_max() == 0;
  const std::string type = flag ? "" : option.get_type_name();
  help.type = type.substr(0, type.find(':'));
  help.choices = ChoicesOf(type);
  help.text = option.get_description();
  help.summary = FirstClause(help.text);
  help.required = option.get_required();
  return help;
}

std::string HeadOf(const OptionHelp& option) {
  return option.name + (option.type.empty() ? "" : " " + option.type);
}

/// Choices that do not fit into the line go on in the next one, after a "|".
std::string BreakChoices(const std::string& head, int width) {
  if (Length(head) <= width) return head;
  const std::size_t end = head.rfind('|', static_cast<std::size_t>(width) - 1);
  if (end == std::string::npos) return head;
  return head.substr(0, end + 1) + "\n" + BreakChoices("      " + head.substr(end + 1), width);
}

/// A name, and beside or below it what it does.
std::string DescribeEntry(const std::string& name, const std::string& what, int width) {
  const std::string head = "  " + name;
  const std::string text = Wrap(what, kTextColumn, width);
  if (Length(head) + 2 > kTextColumn) return BreakChoices(head, width) + "\n" + text;
  return head + text.substr(Length(head));
}

std::string DescribeOption(const OptionHelp& option, int width) {
  return DescribeEntry(HeadOf(option), option.text + (option.required ? " (required)" : ""), width);
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

std::vector<HelpGroup> HelpGroups(const CLI::App& app) {
  std::vector<HelpGroup> groups;
  HelpGroup others{"General", {}};
  for (const CLI::Option* option : app.get_options()) {
    const std::string& name = option->get_group();
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
  for (const HelpGroup& group : HelpGroups(app)) {
    for (const OptionHelp& option : group.options) {
      if (option.required) usage += " " + HeadOf(option);
    }
  }
  return usage + " [options]";
}

std::string HelpText(const CLI::App& app, int width) {
  std::string text = Wrap(app.get_description(), 0, width) + "\nUsage:\n" +
                     Wrap(UsageText(app), 2, width) + DescribeSubcommands(app, width);
  for (const HelpGroup& group : HelpGroups(app)) {
    text += "\n" + group.name + ":\n";
    for (const OptionHelp& option : group.options) text += DescribeOption(option, width);
  }
  const std::string examples = app.get_footer();
  return text + (examples.empty() ? "" : "\nExamples:\n" + examples);
}

int HelpWidth() {
  const char* columns = std::getenv("COLUMNS");
  const std::optional<double> asked = columns == nullptr ? std::nullopt : ParseDouble(columns);
  winsize terminal{};
  int width = kUsualWidth;
  if (asked && *asked >= 1) {
    width = static_cast<int>(std::min<double>(*asked, kWidest));
  } else if (isatty(STDOUT_FILENO) == 1 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &terminal) == 0 &&
             terminal.ws_col > 0) {
    width = terminal.ws_col;
  }
  return std::clamp(width, kNarrowest, kWidest);
}

std::string WrapText(const std::string& text, int indent, int width) {
  return Wrap(text, indent, width);
}

std::string FormatHelpAs(std::string_view format, const CLI::App& app) {
  if (format == "man") return ManPage(app);
  if (format == "bash") return BashCompletion(app);
  if (format == "zsh") return ZshCompletion(app);
  if (format == "fish") return FishCompletion(app);
  if (format == "markdown") return MarkdownHelp(app);
  throw InputError("help comes as man, bash, zsh, fish or markdown, not as \"" +
                   std::string(format) + "\"");
}

}  // namespace regrasp::apps
