#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/plan/reason.h"
#include "sim/actuation/conditions.h"

namespace regrasp::sim {

/// Result of a replay under one condition.
struct ConditionResult {
  HandCondition condition;
  /// whether the condition exists for this hand, for example collision geometry of its fingertips
  bool applies = true;
  /// First step that violates a limit; not valid if none does.
  plan::EntryIndex failed;
  plan::Reason reason = plan::Reason::kNone;
  std::string detail;        ///< description of the violation, or why the condition does not apply
  bool reaches_end = false;  ///< whether the last static grasp is reached
  double end_m = 0;          ///< distance of the object's centroid from the plan at the end
  double end_rad = 0;        ///< rotation of the object from the plan at the end
  bool ends_within = false;  ///< whether the end is reached within the tolerance of the plan
  double margin = 0;         ///< ToleranceMargin

  [[nodiscard]] bool passed() const { return applies && reason == plan::Reason::kNone; }
};

/// Results of replays under several conditions.
struct ConditionSummary {
  std::vector<ConditionResult> results;
  /// Share of the applicable conditions that must pass; nullopt: results are information.
  std::optional<double> required = std::nullopt;

  [[nodiscard]] int applicable() const;
  [[nodiscard]] int passed() const;
  /// Return the number of conditions under which the object ends within the tolerance.
  [[nodiscard]] int ended_within() const;
  /// Return the share of the applicable conditions that pass; 0 if none applies.
  [[nodiscard]] double share() const;
  /// Return whether the share is at least `required`.
  [[nodiscard]] bool enough() const;
};

/// Return the tolerance margin of one step, as a share of each limit.
[[nodiscard]] double ToleranceMargin(const HandMeasures& measures, const HandTolerance& tolerance);

/// Return the smallest tolerance margin of the steps of a replay, as a share of each limit.
/// It is 1 without any deviation and negative if a limit is exceeded. Disturbance tests do not
/// count, nor do torques, because the grasp force follows from their limits.
[[nodiscard]] double ToleranceMargin(const ReplayResult& result, const HandTolerance& tolerance);

/// Replay a plan once under each condition, without disturbance tests.
/// Each replay continues after a violation until the object is lost, so that its end is known. The
/// result does not depend on the number of threads.
/// @param nominal   options of the replay that the conditions change.
/// @param jobs      number of threads.
/// @param progress  callback with the number of completed replays, from several threads but one at
///     a time; may be empty.
/// @throws InputError  if the nominal hand cannot be simulated.
[[nodiscard]] ConditionSummary RunConditions(const kinematics::HandFile& file,
                                             const object::Polyhedron& solid,
                                             const plan::Plan& plan,
                                             const HandReplayOptions& nominal,
                                             const std::vector<HandCondition>& conditions, int jobs,
                                             const std::function<void(int done)>& progress = {});

}  // namespace regrasp::sim
