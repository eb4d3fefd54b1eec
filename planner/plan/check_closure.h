#pragma once

#include <optional>
#include <span>
#include <string>

#include "planner/grasp/required_friction_angle.h"
#include "planner/plan/check_step.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

// Force closure and gravity support of static grasps, for the checks of steps.

/// Return bounds on the larger of two required friction angles; nullopt if either is nullopt.
[[nodiscard]] std::optional<grasp::RequiredFrictionAngle> Larger(
    const std::optional<grasp::RequiredFrictionAngle>& a,
    const std::optional<grasp::RequiredFrictionAngle>& b);

/// Return "is not force closure: requires a friction angle of 30°, found 20°".
[[nodiscard]] std::string AngleNeeded(const CheckContext& context,
                                      const std::optional<grasp::RequiredFrictionAngle>& required);

/// Return the fault of a grasp without force closure.
/// @param grasp  grasp that is not force closure, or not proved to be.
[[nodiscard]] Fault LossOfClosure(const CheckContext& context, const FingerGrasp& grasp,
                                  const std::optional<grasp::RequiredFrictionAngle>& required);

/// Add the fault that force closure is not proved.
void LeaveUnproved(const std::string& why, const Fault& where, StepCheck& check, StepFault& fault);

/// Include a static grasp in a step's force closure and required friction angle.
/// @param path  states of the hand while it holds the object with this grasp; empty: only force
///     closure counts.
/// @returns whether it is gravity-supported instead of force closure.
bool IncludeRest(const CheckContext& context, const FingerGrasp& grasp, const char* name,
                 std::span<const HandState> path, StepCheck& check, StepFault& fault);

}  // namespace regrasp::plan
