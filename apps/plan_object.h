#pragma once

#include <optional>
#include <string>

#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp::apps {

/// How the programs that read a plan were given it and its object.
struct PlanAndObject {
  std::string plan_path;
  std::string object_path;
  bool allow_object_change = false;
  std::optional<double> scale;  ///< of --scale
};

/// @throws InputError  the plan is for another dimension, another object (unless that is allowed),
/// or
///                     another scale.
void CheckPlanFits(const plan::Plan& plan, const object::ObjectFile& object,
                   const PlanAndObject& given);

}  // namespace regrasp::apps
