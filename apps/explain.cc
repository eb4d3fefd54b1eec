#include "apps/explain.h"

#include <algorithm>
#include <functional>
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

/// @param check  name of the check, printed after that of the reason.
/// @param page   page of the documents that has the reason as an anchor, without ending.
std::string EntryText(const FailureReason& reason, std::string_view check, const std::string& page,
                      int width) {
  const std::string name(reason.name);
  return name + " (" + std::string(check) + ")\n\n" +
         WrapText(PlainText(reason.meaning), 0, width) +
         ListText("Usual causes", reason.causes, width) +
         ListText("Remedies", reason.remedies, width) + "\nDocumentation: docs/" + page + ".md#" +
         name + "\n";
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

/// @throws InputError  always; the message lists all reasons.
[[noreturn]] void FailUnknown(std::span<const FailureReason> reasons, std::string_view name) {
  std::string list = kExplainAll;
  for (const FailureReason& reason : reasons) list += ", " + std::string(reason.name);
  throw InputError("--explain: failure reason not found, expected one of " + list + ", found \"" +
                   std::string(name) + "\"");
}

/// Add the option. @param text_of  function that returns the text of a reason.
void AddExplainOption(CLI::App& app, const std::string& help,
                      const std::function<std::string(const std::string& name)>& text_of) {
  const auto explain = [text_of](const std::string& name) {
    std::string text = text_of(name);
    text.pop_back();
    // RunProgram prints the text of CLI::Success and a newline, as for --version.
    throw CLI::Success(text, CLI::ExitCodes::Success);
  };
  BeginGroup(app, "Failure reasons");
  app.add_option_function<std::string>("--explain", explain, help)
      ->type_name("REASON")
      ->trigger_on_parse();
}

/// Return the help of --explain. @param example  name of a reason.
std::string ExplainHelp(std::string_view example) {
  return "Print meaning, causes and remedies of a failure reason, and exit. Example: " +
         std::string(example) + "; all prints all reasons as Markdown";
}

}  // namespace

void AddExplain(CLI::App& app) {
  AddExplainOption(app, ExplainHelp("slipped"),
                   [](const std::string& name) { return ExplainText(name, HelpWidth()); });
}

void AddExplain(CLI::App& app, const ReasonReference& reference) {
  AddExplainOption(
      app, ExplainHelp(reference.reasons.front().name),
      [reference](const std::string& name) { return ExplainText(reference, name, HelpWidth()); });
}

std::string ExplainText(std::string_view name, int width) {
  if (name == kExplainAll) return AllText();
  if (const FailureReason* reason = plan::FindFailureReason(name)) {
    const bool is_cause = reason->check == plan::FailureCheck::kCause;
    return EntryText(*reason, plan::FailureCheckName(reason->check),
                     is_cause ? "likely_causes" : "failure_reasons", width);
  }
  FailUnknown(plan::FailureReasons(), name);
}

std::string ExplainText(const ReasonReference& reference, std::string_view name, int width) {
  if (name == kExplainAll) {
    std::string text = "## Reasons\n";
    for (const FailureReason& reason : reference.reasons) {
      text += "\n" + plan::FailureReasonMarkdown(reason);
    }
    return text;
  }
  const auto found = std::ranges::find(reference.reasons, name, &FailureReason::name);
  if (found == reference.reasons.end()) FailUnknown(reference.reasons, name);
  return EntryText(*found, reference.check, reference.page, width);
}

}  // namespace regrasp::apps
