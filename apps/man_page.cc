#include <algorithm>
#include <cctype>
#include <cstdio>
#include <sstream>

#include "apps/help.h"
#include "apps/program.h"
#include "planner/base/text_table.h"

// Manual page of a program, from the same data as its --help.

namespace regrasp::apps {

namespace {

/// Escape a text for troff (groff_char(7), groff_man(7)).
/// A hyphen becomes a minus sign, and a backslash is printed literally. No line becomes a request,
/// and characters outside ASCII are written by code point.
std::string Escape(const std::string& text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x80) {
      if (text[i] == '\\') {
        escaped += "\\e";
      } else if (text[i] == '-') {
        escaped += "\\-";
      } else {
        escaped += text[i];
      }
      ++i;
      continue;
    }
    const int length = byte >= 0xF0 ? 4 : byte >= 0xE0 ? 3 : 2;
    char32_t code = byte & (0xFF >> (length + 1));
    for (int k = 1; k < length; ++k) code = code << 6 | (text[i + k] & 0x3F);
    char name[sizeof "\\[u10FFFF]"];
    std::snprintf(name, sizeof name, "\\[u%04X]", static_cast<unsigned>(code));
    escaped += name;
    i += length;
  }
  const bool request = escaped.starts_with('.') || escaped.starts_with('\'');
  return (request ? "\\&" : "") + escaped;
}

/// Escape the lines of a text; each starts a new line of the page.
std::string EscapeLines(const std::string& text) {
  std::string page;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    page += (page.empty() ? "" : ".br\n") + Escape(line) + "\n";
  }
  return page;
}

std::string Upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

std::string OptionText(const OptionHelp& option) {
  return ".TP\n.B " + Escape(option.name) +
         (option.type.empty() ? "" : " \\fI" + Escape(option.type) + "\\fR") + "\n" +
         EscapeLines(option.text + (option.required ? " (required)" : ""));
}

/// Return the list of commands, each with a reference to its page.
std::string CommandsText(const CLI::App& app) {
  std::string text;
  for (const CLI::App* command : Subcommands(app)) {
    text += ".TP\n.BR " + Escape(command->get_name()) + " (1)\n" +
            Escape(command->get_description()) + "\n";
  }
  return text.empty() ? "" : ".SH COMMANDS\n" + text;
}

constexpr char kExitStatus[] =
    ".SH EXIT STATUS\n"
    ".TP\n.B 0\nsuccess; from\n.BR validate (1):\npass\n"
    ".TP\n.B 1\nnegative result: no plan found, fail, or time limit reached\n"
    ".TP\n.B 2\nbad usage or bad input: one line with the file, the element and the "
    "problem\n"
    ".TP\n.B 3\nerror of the environment\n";

}  // namespace

std::string ManPage(const CLI::App& app) {
  std::string page = ".TH " + Upper(app.get_name()) + " 1 \"\" \"regrasp " + ProgramVersion() +
                     "\" \"regrasp\"\n.SH NAME\n" + app.get_name() + " \\- " +
                     Escape(app.get_description()) + "\n.SH SYNOPSIS\n" + Escape(UsageText(app)) +
                     "\n" + CommandsText(app) + ".SH OPTIONS\n";
  for (const HelpGroup& group : HelpGroups(app)) {
    page += ".SS " + Escape(group.name) + "\n";
    for (const OptionHelp& option : group.options) page += OptionText(option);
  }
  page += kExitStatus;
  if (!app.get_footer().empty()) {
    page += ".SH EXAMPLES\n.nf\n" + Escape(app.get_footer()) + ".fi\n";
  }
  return page;
}

}  // namespace regrasp::apps

// Reference page of a command, docs/command_NAME.md, from its help texts.

namespace regrasp::apps {

namespace {

/// Format all lines of a text but the first as items of a list.
std::string AsItems(const std::string& text) {
  std::string items;
  for (const char c : text) items += c == '\n' ? "\n  - " : std::string(1, c);
  return items;
}

/// Return the table of commands for docs/commands.md, the page of `regrasp`.
/// It links to the pages of all commands.
std::string CommandTable(const CLI::App& app) {
  std::string text = "\n## Commands\n\n| command | task |\n| --- | --- |\n";
  for (const CLI::App* command : Subcommands(app)) {
    const std::string& name = command->get_name();
    text += "| [" + name + "](command_" + name + ".md) | " + command->get_description() + " |\n";
  }
  return text +
         "\n[regrasp-convert](command_convert.md) converts grasps and plans between formats.\n";
}

std::string GroupSection(const HelpGroup& group) {
  std::string text = "\n## " + group.name + "\n\n";
  for (const OptionHelp& option : group.options) {
    text += "- `" + NamesOf(option) + "` " + (option.required ? "(required) " : "") +
            (option.rare ? "(rare) " : "") + AsItems(option.text) + "\n";
  }
  return text;
}

}  // namespace

std::string MarkdownHelp(const CLI::App& app) {
  const bool commands = !Subcommands(app).empty();
  const std::string command = (commands ? "" : "regrasp ") + app.get_name();
  std::string text = "# " + command + "\n\nThis page is the reference of `" + command + "`. `" +
                     command + " --help-all` prints the same text. [Exit codes](exit_codes.md) " +
                     "are those of all commands.\n\n" + app.get_description() + "\n\n```\n" +
                     (commands ? "" : "regrasp ") + UsageText(app) + "\n```\n";
  if (commands) text += CommandTable(app);
  for (const HelpGroup& group : HelpGroups(app)) text += GroupSection(group);
  return text + "\n## Examples\n\n```sh\n" + app.get_footer() + "```\n";
}

}  // namespace regrasp::apps
