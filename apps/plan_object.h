#pragma once

#include <optional>
#include <string>

#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp::apps {

/// Return a file's description for messages: "cube.obj (SHA-256 3f2a91c0d4e7…)".
[[nodiscard]] std::string DescribeFile(const std::string& name, const std::string& sha256);

/// Command-line values of a plan and its object.
struct PlanAndObject {
  std::string plan_path;
  std::string object_path;
  bool allow_object_change = false;
  std::optional<double> scale;  ///< value of --scale
};

/// Read the object of a plan.
/// If the plan is for a repaired object, the object is repaired with the same options. The solid
/// that the program `repair` wrote is also accepted. Several closed shells are read as the plan
/// states.
/// @throws InputError  as ReadObject and ReadRepaired.
[[nodiscard]] object::ObjectFile ReadObjectOf(const plan::Plan& plan, const std::string& path,
                                              const object::Reading& reading);

/// Check that a plan fits an object and the command line.
/// @throws InputError  if the plan is for another dimension, another object (unless that is
///     allowed), or another scale.
void CheckPlanFits(const plan::Plan& plan, const object::ObjectFile& object,
                   const PlanAndObject& given);

}  // namespace regrasp::apps
