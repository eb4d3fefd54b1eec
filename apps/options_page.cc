// The part of docs/options.md that is about a program, from what its --help says.

#include "apps/help.h"

namespace regrasp::apps {

std::string MarkdownHelp(const CLI::App& app) {
  std::string text = "## " + app.get_name() + "\n\n" + app.get_description() + "\n\n```\n" +
                     UsageText(app) + "\n```\n";
  for (const HelpGroup& group : HelpGroups(app)) {
    text += "\n### " + group.name + "\n\n";
    for (const OptionHelp& option : group.options) {
      text += "- `" + option.name + (option.type.empty() ? "" : " " + option.type) + "` " +
              (option.required ? "(required) " : "") + option.text + "\n";
    }
  }
  return text + "\n```sh\n" + app.get_footer() + "```\n";
}

}  // namespace regrasp::apps
