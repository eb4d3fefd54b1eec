#include <algorithm>
#include <array>

#include "planner/base/angle.h"
#include "planner/base/number.h"
#include "sim/report.h"

namespace regrasp {

namespace {

constexpr int kColumns = 6;
using Row = std::array<std::string, kColumns>;

/// Angles to a hundredth of a degree, lengths to two significant digits.
constexpr int kAngleDecimals = 2;
constexpr int kLengthDigits = 2;

constexpr char kNothing[] = "-";

std::string RequiredAngle(const ReportStep& step) {
  if (step.check.skipped) return kNothing;
  if (!step.check.required) return "none";
  return FormatFixed(Degrees(step.check.required->upper), kAngleDecimals);
}

Row MakeRow(const ReportStep& step) {
  const auto length = [&](double StepReplay::*member) -> std::string {
    return step.replay ? FormatShort((*step.replay).*member, kLengthDigits) : kNothing;
  };
  std::string verdict(VerdictName(step.verdict()));
  if (step.verdict() == Verdict::kFail) verdict += ": " + std::string(ReasonName(step.reason()));
  return {std::to_string(step.check.index),
          step.check.kind,
          RequiredAngle(step),
          length(&StepReplay::displacement_m),
          length(&StepReplay::slip_m),
          verdict};
}

/// All columns but the last are filled up to their widest entry.
std::string FormatRows(const std::vector<Row>& rows) {
  std::array<std::size_t, kColumns> width = {};
  for (const Row& row : rows) {
    for (int i = 0; i < kColumns; ++i) width[i] = std::max(width[i], row[i].size());
  }
  std::string text;
  for (const Row& row : rows) {
    for (int i = 0; i < kColumns - 1; ++i) {
      text += row[i] + std::string(width[i] - row[i].size() + 2, ' ');
    }
    text += row.back() + "\n";
  }
  return text;
}

std::string FormatWeakest(const Report& report) {
  const int weakest = report.weakest_step();
  if (weakest < 0) return "";
  const ReportStep& step = report.steps[weakest];
  return "weakest: step " + std::to_string(weakest) + " (" + step.check.kind +
         "), which needs a friction half-angle of " + RequiredAngle(step) + " of " +
         FormatFixed(Degrees(report.half_angle), kAngleDecimals) + " degrees\n";
}

std::string FormatFailure(const Report& report) {
  for (const ReportStep& step : report.steps) {
    if (step.verdict() == Verdict::kFail && !step.detail().empty()) {
      return "step " + std::to_string(step.check.index) + ": " + step.detail() + "\n";
    }
  }
  return "";
}

std::string FormatUndecided(const Report& report) {
  long undecided = 0;
  for (const ReportStep& step : report.steps) undecided += step.check.undecided;
  if (undecided == 0) return "";
  return "undecided: " + std::to_string(undecided) +
         " pieces of aligns, a millionth of the path each\n";
}

}  // namespace

std::string FormatReportTable(const Report& report) {
  std::vector<Row> rows = {{"step", "kind", "required_deg", "displacement_m", "slip_m", "verdict"}};
  for (const ReportStep& step : report.steps) rows.push_back(MakeRow(step));
  return FormatRows(rows) + FormatFailure(report) + FormatUndecided(report) +
         FormatWeakest(report) + "verdict: " + (report.passed() ? "pass" : "fail") + "\n";
}

}  // namespace regrasp
