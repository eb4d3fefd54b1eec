#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/check.h"
#include "sim/replay.h"

namespace regrasp {

/// One entry of a report: the hold or a step, what the analysis and the replay say of it.
struct ReportStep {
  StepCheck check;
  std::optional<StepReplay>
      replay;         ///< none where the analytic check failed or the step is skipped
  std::string frame;  ///< file name of the picture, empty where there is none

  [[nodiscard]] Reason reason() const;
  [[nodiscard]] bool passed() const;
};

/// Everything that `validate` says of a plan; report.json is this (docs/report.schema.json).
struct Report {
  std::string object_file, object_sha256;
  std::string plan_file, plan_sha256;
  double scale = 1;
  int dimension = 3;
  double half_angle = 0;  ///< checked against, radians
  ReplaySettings settings;
  std::vector<ReportStep> steps;

  [[nodiscard]] bool passed() const;
  /// The step with the smallest margin to its required half-angle; −1 where no step has one.
  [[nodiscard]] int weakest_step() const;
};

/// Checks a plan analytically and replays the steps that pass, up to the first that fails.
/// `object_sha256`, file names and frames are left to the caller.
[[nodiscard]] Report Validate(const Object& object, const Plan& plan, const CheckOptions& check,
                              const ReplayOptions& replay, const ReplayObserver& observer = {});

[[nodiscard]] std::string FormatReportJson(const Report& report);
[[nodiscard]] std::string FormatReportJunit(const Report& report);
/// A readable table: a line per step with required half-angle, displacement and verdict, then the
/// weakest step.
[[nodiscard]] std::string FormatReportTable(const Report& report);

}  // namespace regrasp
