#include <algorithm>

#include "sim/report.h"

namespace regrasp {

namespace {

/// Text as XML 1.0 can hold it; control characters, which it cannot, become question marks.
std::string Escape(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
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
      default: {
        const bool control = static_cast<unsigned char>(c) < 0x20;
        out += control ? '?' : c;
      }
    }
  }
  return out;
}

std::string Attribute(const std::string& name, std::string_view value) {
  return " " + name + "=\"" + Escape(value) + "\"";
}

std::string FormatCase(const Report& report, const ReportStep& step) {
  const std::string name = "step " + std::to_string(step.check.index) + " " + step.check.kind;
  const std::string head =
      "  <testcase" + Attribute("classname", report.plan_file) + Attribute("name", name);
  switch (step.verdict()) {
    case Verdict::kPass:
      return head + "/>\n";
    case Verdict::kSkipped:
      return head + "><skipped/></testcase>\n";
    case Verdict::kFail:
      return head + "><failure" + Attribute("message", ReasonName(step.reason())) + ">" +
             Escape(step.detail()) + "</failure></testcase>\n";
  }
  return "";
}

std::string Count(const Report& report, Verdict verdict) {
  return std::to_string(
      std::count_if(report.steps.begin(), report.steps.end(),
                    [verdict](const ReportStep& step) { return step.verdict() == verdict; }));
}

}  // namespace

std::string FormatReportJunit(const Report& report) {
  const std::string counts = Attribute("tests", std::to_string(report.steps.size())) +
                             Attribute("failures", Count(report, Verdict::kFail)) +
                             Attribute("errors", "0") +
                             Attribute("skipped", Count(report, Verdict::kSkipped));
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n <testsuite" +
                    Attribute("name", report.plan_file) + counts + ">\n";
  for (const ReportStep& step : report.steps) xml += FormatCase(report, step);
  return xml + " </testsuite>\n</testsuites>\n";
}

}  // namespace regrasp
