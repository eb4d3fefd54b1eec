#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/plan/reason.h"
#include "sim/validation/validation.h"

namespace regrasp::report {

// This package formats the data of sim/validation/validation_report.h.
using validation::FileDigest;
using validation::GraspReport;
using validation::Report;
using validation::ReportStep;
using validation::RunRecord;
using validation::Verdict;

/// Return "pass", "fail" or "skipped".
[[nodiscard]] std::string_view VerdictName(Verdict verdict);

/// Return "pass", or "fail: slipped".
[[nodiscard]] std::string ReasonText(plan::Reason reason);

/// Return "pass", "skipped" or "fail: slipped".
[[nodiscard]] std::string VerdictText(const ReportStep& step);

/// Return the limits that the verdict of a replay by a hand relies on, in one line.
/// Example: "torque 1 N·m, 16 control ranges, 16 joint ranges".
[[nodiscard]] std::string LimitsText(const std::vector<sim::DriveLimits>& limits);

/// Return readable warnings that do not change the verdict.
///
/// - each finger switch with a smaller contact region than the plan claims
/// - each sliding step whose certificate does not prove it
/// - the assumptions of a replay by a hand
[[nodiscard]] std::vector<std::string> Warnings(const Report& report);

/// Return the property of every grasp of a report that passes: "force closure", with "or supported
/// by gravity" if this holds for some grasps.
[[nodiscard]] std::string StabilityText(const Report& report);

/// Format report.json.
/// In addition to the members that docs/format_report.md defines, each step has a readable `detail`
/// and `undecided`, and a sliding step its mode. Bytes of file names that are not UTF-8 are
/// replaced.
[[nodiscard]] std::string FormatReportJson(const Report& report);

/// Format a readable table.
/// It has a line per step with required friction angle, displacement, slip, verdict and contact
/// region. It ends with the verdict and the number of trials that pass. A plan that fails starts
/// with its failure, reason and suggested fix (failure.h). One that passes has its weakest step.
[[nodiscard]] std::string FormatReportTable(const Report& report);

}  // namespace regrasp::report
