// Reference page of a command, docs/command_NAME.md, from its help texts.

#include "apps/help.h"

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
