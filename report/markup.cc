#include "report/markup.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "planner/base/number.h"
#include "planner/base/text_table.h"
#include "report/failure.h"

namespace regrasp::report {

namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

/// The void elements of the HTML standard (section "Elements").
constexpr std::array<std::string_view, 13> kVoidTags = {"area",   "base",  "br",    "col",  "embed",
                                                        "hr",     "img",   "input", "link", "meta",
                                                        "source", "track", "wbr"};

}  // namespace

std::string EscapeMarkup(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const Utf8Character character = TakeCharacter(text);
    switch (character.code) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      case '\t':
      case '\n':
        out += character.bytes;
        break;
      default:
        out += !character.is_valid || IsInvisible(character.code) ? kReplacement : character.bytes;
    }
  }
  return out;
}

void Element::Add(std::string_view text) { content_ += EscapeMarkup(text); }

void Element::Add(const Element& child) { content_ += child.Format(); }

void Element::Add(const std::vector<Element>& children) {
  for (const Element& child : children) {
    if (!content_.ends_with('\n')) content_ += "\n";
    content_ += child.Format() + "\n";
  }
}

void Element::AddVerbatim(std::string_view text) { content_ += text; }

std::string Element::Format() const {
  const std::string open = "<" + tag_ + attributes_;
  if (content_.empty() && std::ranges::find(kVoidTags, tag_) != kVoidTags.end())
    return open + " />";
  return open + ">" + content_ + "</" + tag_ + ">";
}

std::string Element::FormatAttributes(const Attributes& attributes) {
  std::string text;
  for (const auto& [name, value] : attributes) {
    text += " " + name + "=\"" + EscapeMarkup(value) + "\"";
  }
  return text;
}

namespace {

/// Return the text of a failure, with the path of its image.
std::string FailureText(const JunitCase& result) {
  return result.text + (result.picture.empty() ? "" : "\npicture: " + result.picture);
}

/// Decimals of times in seconds, as in other JUnit files.
constexpr int kTimeDecimals = 3;

Element MakeCase(const std::string& suite, const JunitCase& result) {
  Element element("testcase", {{"classname", suite},
                               {"file", suite},
                               {"name", result.name},
                               {"time", FormatFixed(result.seconds, kTimeDecimals)}});
  const Attributes message = {{"message", result.message}};
  switch (result.outcome) {
    case JunitOutcome::kPassed:
      break;
    case JunitOutcome::kFailed:
      element.Add(Element("failure", message, FailureText(result)));
      if (!result.picture.empty()) {
        element.Add(Element("system-out", {}, "[[ATTACHMENT|" + result.picture + "]]"));
      }
      break;
    case JunitOutcome::kError:
      element.Add(Element("error", message, result.text));
      break;
    case JunitOutcome::kSkipped:
      element.Add(result.message.empty() ? Element("skipped")
                                         : Element("skipped", message, result.text));
      break;
  }
  return element;
}

/// Return the attributes with the numbers of cases and the time of suites.
Attributes TotalsOf(std::span<const JunitSuite> suites) {
  const auto count = [&](JunitOutcome outcome) {
    std::ptrdiff_t sum = 0;
    for (const JunitSuite& suite : suites) {
      sum += std::ranges::count(suite.cases, outcome, &JunitCase::outcome);
    }
    return std::to_string(sum);
  };
  std::size_t tests = 0;
  double seconds = 0;
  for (const JunitSuite& suite : suites) {
    tests += suite.cases.size();
    seconds += suite.seconds;
  }
  return {{"tests", std::to_string(tests)},
          {"failures", count(JunitOutcome::kFailed)},
          {"errors", count(JunitOutcome::kError)},
          {"skipped", count(JunitOutcome::kSkipped)},
          {"time", FormatFixed(seconds, kTimeDecimals)}};
}

Element MakeSuite(const JunitSuite& suite) {
  std::vector<Element> cases;
  for (const JunitCase& result : suite.cases) cases.push_back(MakeCase(suite.name, result));
  Attributes attributes = TotalsOf({&suite, 1});
  attributes.insert(attributes.begin(), {"name", suite.name});
  return Element("testsuite", attributes, cases);
}

}  // namespace

std::string JunitText(const std::string& detail, const std::string& why,
                      const std::string& suggested_fix) {
  std::string text = detail;
  for (const auto& [name, said] : {std::pair{"why", &why}, {"help", &suggested_fix}}) {
    if (!said->empty()) text += std::string("\n") + name + ": " + *said;
  }
  return text;
}

JunitOutcome OutcomeOf(std::string_view verdict) {
  if (verdict == "pass") return JunitOutcome::kPassed;
  return verdict == "fail" ? JunitOutcome::kFailed : JunitOutcome::kSkipped;
}

namespace {

/// Add a case for each condition. Without a required share their failures are information, and such
/// cases are skipped.
void AddConditionCases(const sim::ConditionSummary& summary, JunitSuite& suite) {
  for (const sim::ConditionResult& result : summary.results) {
    const bool counts = result.applies && summary.required.has_value();
    JunitOutcome outcome = result.passed() ? JunitOutcome::kPassed : JunitOutcome::kSkipped;
    if (counts && !result.passed() && !summary.enough()) outcome = JunitOutcome::kFailed;
    const std::string reason =
        result.applies ? std::string(plan::ReasonName(result.reason)) : "not applicable";
    suite.cases.push_back({.name = "condition " + result.condition.name,
                           .outcome = outcome,
                           .message = reason,
                           .text = result.detail});
  }
}

}  // namespace

JunitSuite MakeJunitSuite(const Report& report, const std::filesystem::path& folder) {
  JunitSuite suite{report.plan_file, {}};
  const auto failure = DescribeFailure(report);
  for (const ReportStep& step : report.steps) {
    const bool failed = failure && failure->entry == step.check.index;
    suite.cases.push_back(
        {.name = "step " + std::to_string(step.check.index) + " " + step.check.kind,
         .outcome = OutcomeOf(VerdictName(step.verdict())),
         .message = std::string(plan::ReasonName(step.reason())),
         .text = JunitText(step.detail(), failed ? failure->why : "",
                           failed ? failure->suggested_fix : ""),
         .picture = step.frame.empty() ? "" : (folder / step.frame).string()});
  }
  if (report.trials) {
    const bool enough = report.trials->enough();
    suite.cases.push_back(
        {.name = "trials",
         .outcome = enough ? JunitOutcome::kPassed : JunitOutcome::kFailed,
         .message = enough ? "" : kTrialsFailed,
         .text = failure ? JunitText(failure->what, failure->why, failure->suggested_fix) : ""});
  }
  if (report.conditions) AddConditionCases(*report.conditions, suite);
  return suite;
}

void SetCaseTimes(const std::vector<double>& seconds, JunitSuite& suite) {
  const std::size_t count = std::min(seconds.size(), suite.cases.size());
  for (std::size_t i = 0; i < count; ++i) suite.cases[i].seconds = seconds[i];
}

std::string FormatJunit(const std::vector<JunitSuite>& suites) {
  std::vector<Element> elements;
  for (const JunitSuite& suite : suites) elements.push_back(MakeSuite(suite));
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" +
         Element("testsuites", TotalsOf(suites), elements).Format() + "\n";
}

}  // namespace regrasp::report
