#include "apps/explain.h"

#include <sstream>

#include "apps/help.h"
#include "planner/base/error.h"
#include "planner/plan/failure_reasons.h"

namespace regrasp::apps {

namespace {

using plan::FailureReason;

constexpr int kItemIndent = 4;

/// Return one line without the markup of Markdown: `code` and [`text`](link).
std::string PlainText(std::string_view markdown) {
  std::string text;
  bool link = false;
  for (std::size_t i = 0; i < markdown.size(); ++i) {
    if (markdown.substr(i).starts_with("](")) link = true;
    if (!link && markdown[i] != '`' && !markdown.substr(i).starts_with("[`")) text += markdown[i];
    if (link && markdown[i] == ')') link = false;
  }
  return text;
}

/// Return a heading and one item per line of `items`.
std::string ListText(const std::string& heading, std::string_view items, int width) {
  std::string text = "\n" + heading + ":\n";
  std::istringstream lines{std::string(items)};
  for (std::string line; std::getline(lines, line);) {
    std::string item = WrapText(PlainText(line), kItemIndent, width);
    item[kItemIndent - 2] = '-';
    text += item;
  }
  return text;
}

std::string EntryText(const FailureReason& reason, int width) {
  const std::string name(reason.name);
  return name + " (" + std::string(plan::FailureCheckName(reason.check)) + ")\n\n" +
         WrapText(PlainText(reason.meaning), 0, width) +
         ListText("Usual causes", reason.causes, width) +
         ListText("Remedies", reason.remedies, width) + "\nDocumentation: docs/" +
         (reason.check == plan::FailureCheck::kCause ? "likely_causes" : "failure_reasons") +
         ".md#" + name + "\n";
}

/// Return all entries as Markdown, with headings for reasons and likely causes.
std::string AllText() {
  std::string text = "## Reasons\n";
  bool causes = false;
  for (const FailureReason& reason : plan::FailureReasons()) {
    if (!causes && reason.check == plan::FailureCheck::kCause) {
      causes = true;
      text += "\n## Likely causes\n";
    }
    text += "\n" + plan::FailureReasonMarkdown(reason);
  }
  return text;
}

}  // namespace

void AddExplain(CLI::App& app) {
  const auto explain = [](const std::string& name) {
    std::string text = ExplainText(name, HelpWidth());
    text.pop_back();
    // RunProgram prints the text of CLI::Success and a newline, as for --version.
    throw CLI::Success(text, CLI::ExitCodes::Success);
  };
  BeginGroup(app, "Failure reasons");
  app.add_option_function<std::string>(
         "--explain", explain,
         "Print meaning, causes and remedies of a failure reason, and exit. Example: slipped; all "
         "prints all reasons as Markdown")
      ->type_name("REASON")
      ->trigger_on_parse();
}

std::string ExplainText(std::string_view name, int width) {
  if (name == kExplainAll) return AllText();
  if (const FailureReason* reason = plan::FindFailureReason(name)) {
    return EntryText(*reason, width);
  }
  std::string list = kExplainAll;
  for (const FailureReason& reason : plan::FailureReasons()) {
    list += ", " + std::string(reason.name);
  }
  throw InputError("--explain: failure reason not found, expected one of " + list + ", found \"" +
                   std::string(name) + "\"");
}

}  // namespace regrasp::apps
