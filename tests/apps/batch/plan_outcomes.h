#pragma once

#include <optional>
#include <string>

#include "apps/batch/batch_summary.h"

namespace regrasp::apps {

/// Sample results for a plan of a batch, with names for tests.
inline PlanOutcome Passed(const std::string& name) {
  PlanOutcome plan{name, name + ".json", PlanVerdict::kPass, ReportSummary(), "", false, 0, {}};
  ReportSummary& report = *plan.report;
  report.passed = true;
  report.object = "cube.obj";
  report.size = "10.4 cm across, 216 g";
  report.friction_angle_deg = 20;
  report.entries = {{"hold", "pass", "", "", "000_hold.png"},
                    {"switch", "pass", "", "", "001_switch.png"}};
  report.files = {{"000_hold.png", ""}, {"overview.png", ""}};
  report.weakest_step = 1;
  report.required_friction_angle_deg = 17.25;
  return plan;
}

inline PlanOutcome Failed(const std::string& name) {
  PlanOutcome plan = Passed(name);
  plan.verdict = PlanVerdict::kFail;
  plan.report->passed = false;
  plan.report->entries[1] = {"switch",         "fail",     "slipped",      "finger <2> slipped",
                             "001_switch.png", "it stays", "more friction"};
  plan.report->entries.push_back({"align", "skipped", "", "", ""});
  return plan;
}

inline PlanOutcome Broken(const std::string& name, PlanVerdict verdict,
                          const std::string& message) {
  return {name, name + ".json", verdict, std::nullopt, message, false, 0, {}};
}

}  // namespace regrasp::apps
