#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/base/json.h"
#include "report/report.h"
#include "sim/actuation/condition_replays.h"
#include "sim/replay/trials.h"
#include "sim/scene/settings.h"

namespace regrasp::report {

/// Return the grasp force and its reason in at most 60 characters: "200 N, 9 × weight: …".
[[nodiscard]] std::string GraspForceText(const sim::ReplaySettings& settings);
/// Return what the controller of a hand measures of the object's pose, and with which errors.
[[nodiscard]] std::string FeedbackText(const sim::HandSensing& sensing);

/// Weakest direction of all static grasps of a report, measured by the replay.
struct WeakestDisturbance {
  plan::EntryIndex step{0};
  sim::ResistedWrench resisted_wrench;
};

/// Return the weakest direction; nullopt if no entry has measurements.
[[nodiscard]] std::optional<WeakestDisturbance> FindWeakestDisturbance(const Report& report);

/// Format the resisted wrench of each entry and direction, in percent of the grasp force.
/// The replay measures it. The table also has the smallest value, and that of the analysis. The
/// result is empty if there are no measurements.
[[nodiscard]] std::string FormatResistedWrenchTable(const Report& report);

/// Return the member `trials` of report.json (docs/formats.md).
[[nodiscard]] Json TrialsJson(const sim::TrialSummary& summary);

/// Return "in 14 of 20 trials", to follow "pass". Every verdict on trials includes their counts.
[[nodiscard]] std::string TrialsPassText(const sim::TrialSummary& summary);

/// Return "14 of 20 trials pass (70 %), and --trials min-pass-rate requires 100 %".
[[nodiscard]] std::string TrialsRequiredText(const sim::TrialSummary& summary);

/// Return "93 of 100 pass: 93 %, with 95 % confidence between 86.1 and 97.1 %; required 100 %".
[[nodiscard]] std::string TrialsShareText(const sim::TrialSummary& summary);

/// Return the counts of failed trials by reason and by first step; empty if none failed. Example:
/// "7 of 100 trials with noise fail: 5 slipped, 2 object-moved; first in step 0: 4, step 3: 3".
[[nodiscard]] std::string TrialsFailureText(const sim::TrialSummary& summary);

/// Return the noise of the trials.
/// Example: "contacts off by 0.01 diameters, friction by 10 %, mass by 10 % (standard deviations);
/// seed 0".
[[nodiscard]] std::string TrialsNoiseText(const sim::TrialSummary& summary);

/// Name of the reason of a plan whose steps and trials pass but too few of whose conditions do.
inline constexpr char kConditionsFailed[] = "conditions-failed";

/// Return the member `conditions` of report.json.
[[nodiscard]] Json ConditionsJson(const sim::ConditionSummary& summary);

/// Return "pass", "fail: slipped" or "not applicable".
[[nodiscard]] std::string ConditionVerdictText(const sim::ConditionResult& result);

/// Return "under 20 of 26 conditions".
[[nodiscard]] std::string ConditionsPassText(const sim::ConditionSummary& summary);

/// Return "20 of 26 pass, 23 of 26 end within the tolerance; required 90 %".
[[nodiscard]] std::string ConditionsShareText(const sim::ConditionSummary& summary);

/// Return "6 of 26 conditions fail: camera (slipped), blind (object-moved), …"; empty if none does.
[[nodiscard]] std::string ConditionsFailureText(const sim::ConditionSummary& summary);

/// Return "20 of 26 conditions pass (76.9 %), --conditions requires 90 %".
[[nodiscard]] std::string ConditionsRequiredText(const sim::ConditionSummary& summary);

/// Return a table with one row per condition; empty without conditions.
[[nodiscard]] std::string FormatConditionTable(const Report& report);

}  // namespace regrasp::report
