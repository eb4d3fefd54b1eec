// The section of docs/options.md on a program, from its help texts.

#include "apps/help.h"

namespace regrasp::apps {

namespace {

/// Format all lines of a text but the first as items of a list.
std::string AsItems(const std::string& text) {
  std::string items;
  for (const char c : text) items += c == '\n' ? "\n  - " : std::string(1, c);
  return items;
}

}  // namespace

std::string MarkdownHelp(const CLI::App& app) {
  std::string text = "## " + app.get_name() + "\n\n" + app.get_description() + "\n\n```\n" +
                     UsageText(app) + "\n```\n";
  for (const HelpGroup& group : HelpGroups(app)) {
    if (group.name == kGeneralTitle) continue;  // the page lists them once, for all programs
    text += "\n### " + group.name + "\n\n";
    for (const OptionHelp& option : group.options) {
      text += "- `" + NamesOf(option) + "` " + (option.required ? "(required) " : "") +
              (option.rare ? "(rare) " : "") + AsItems(option.text) + "\n";
    }
  }
  return text + "\n```sh\n" + app.get_footer() + "```\n";
}

}  // namespace regrasp::apps
