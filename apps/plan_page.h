#pragma once

#include <string>
#include <vector>

#include "planner/kinematics/hand_file.h"
#include "planner/object/object.h"
#include "planner/plan/check.h"
#include "planner/plan/plan.h"

namespace regrasp::apps {

/// Outputs of `plan` by format. Names of files that are not written are empty.
struct PlanOutputs {
  std::string plan;  ///< plan file; "-": standard output
  std::string page;  ///< page with the interactive 3-D replay of the plan
};

/// Sort the outputs of the command line by format: .html or .htm, otherwise a plan file.
/// @throws InputError  if two outputs have the same format.
[[nodiscard]] PlanOutputs SortPlanOutputs(const std::vector<std::string>& outputs);

/// Return a self-contained page with the interactive 3-D replay of a plan that was not simulated.
/// @param check  result of the analytic check of the plan.
/// @param hand   hand of the plan; null: a plan without a hand.
/// @param name   title of the page: name of the plan file.
[[nodiscard]] std::string FormatPlanPage(const object::ObjectFile& object, const plan::Plan& plan,
                                         const plan::PlanCheck& check,
                                         const kinematics::HandFile* hand, const std::string& name);

}  // namespace regrasp::apps
