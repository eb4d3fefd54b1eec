// The reference page of a command, docs/command_NAME.md, from the texts that --help prints.

#include "apps/help.h"

namespace regrasp::apps {

namespace {

/// The page of `regrasp` itself, docs/commands.md, links to the pages of all commands.
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
    text += "- `" + option.name + (option.type.empty() ? "" : " " + option.type) + "` " +
            (option.required ? "(required) " : "") + option.text + "\n";
  }
  return text;
}

}  // namespace

std::string MarkdownHelp(const CLI::App& app) {
  const bool commands = !Subcommands(app).empty();
  const std::string command = (commands ? "" : "regrasp ") + app.get_name();
  std::string text = "# " + command + "\n\nThis page is the reference of `" + command + "`. `" +
                     command + " --help` prints the same text. [Exit codes](exit_codes.md) are " +
                     "those of all commands.\n\n" + app.get_description() + "\n\n```\n" +
                     (commands ? "" : "regrasp ") + UsageText(app) + "\n```\n";
  if (commands) text += CommandTable(app);
  for (const HelpGroup& group : HelpGroups(app)) text += GroupSection(group);
  return text + "\n## Examples\n\n```sh\n" + app.get_footer() + "```\n";
}

}  // namespace regrasp::apps
