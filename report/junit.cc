#include "report/junit.h"

#include <algorithm>

#include "planner/base/markup.h"

namespace regrasp {

namespace {

JunitOutcome OutcomeOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::kPass:
      return JunitOutcome::kPassed;
    case Verdict::kFail:
      return JunitOutcome::kFailed;
    case Verdict::kSkipped:
      return JunitOutcome::kSkipped;
  }
  return JunitOutcome::kError;
}

std::string FormatOutcome(const JunitCase& result) {
  const std::string message = Attribute("message", result.message);
  switch (result.outcome) {
    case JunitOutcome::kPassed:
      return "";
    case JunitOutcome::kFailed:
      return Element("failure", message, EscapeMarkup(result.text));
    case JunitOutcome::kError:
      return Element("error", message, EscapeMarkup(result.text));
    case JunitOutcome::kSkipped:
      return "<skipped/>";
  }
  return "";
}

std::string FormatCase(const std::string& suite, const JunitCase& result) {
  const std::string head =
      "  <testcase " + Attribute("classname", suite) + " " + Attribute("name", result.name);
  const std::string outcome = FormatOutcome(result);
  return outcome.empty() ? head + "/>\n" : head + ">" + outcome + "</testcase>\n";
}

std::string FormatSuite(const JunitSuite& suite) {
  const auto count = [&](JunitOutcome outcome) {
    return std::to_string(std::ranges::count(suite.cases, outcome, &JunitCase::outcome));
  };
  std::string xml = " <testsuite " + Attribute("name", suite.name) + " " +
                    Attribute("tests", std::to_string(suite.cases.size())) + " " +
                    Attribute("failures", count(JunitOutcome::kFailed)) + " " +
                    Attribute("errors", count(JunitOutcome::kError)) + " " +
                    Attribute("skipped", count(JunitOutcome::kSkipped)) + ">\n";
  for (const JunitCase& result : suite.cases) xml += FormatCase(suite.name, result);
  return xml + " </testsuite>\n";
}

}  // namespace

JunitSuite MakeJunitSuite(const Report& report) {
  JunitSuite suite{report.plan_file, {}};
  for (const ReportStep& step : report.steps) {
    suite.cases.push_back({"step " + std::to_string(step.check.index) + " " + step.check.kind,
                           OutcomeOf(step.verdict()), std::string(ReasonName(step.reason())),
                           step.detail()});
  }
  return suite;
}

std::string FormatJunit(const std::vector<JunitSuite>& suites) {
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  for (const JunitSuite& suite : suites) xml += FormatSuite(suite);
  return xml + "</testsuites>\n";
}

}  // namespace regrasp
