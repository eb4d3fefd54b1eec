#pragma once

#include <optional>
#include <string>

#include "planner/object/object.h"
#include "planner/object/reading.h"
#include "planner/plan/plan.h"

namespace regrasp::apps {

/// Return how messages tell a file by its content: "cube.obj (SHA-256 3f2a91c0d4e7…)".
[[nodiscard]] std::string DescribeFile(const std::string& name, const std::string& sha256);

/// How the programs that read a plan were given it and its object.
struct PlanAndObject {
  std::string plan_path;
  std::string object_path;
  bool allow_object_change = false;
  std::optional<double> scale;  ///< of --scale
};

/// Reads the object of a plan; where the plan is for a repaired one, repairs it in the same way
/// again, and of several closed shells makes what the plan says. The solid that the program
/// `repair` wrote does as well.
/// @throws InputError  as ReadObject and ReadRepaired.
[[nodiscard]] object::ObjectFile ReadObjectOf(const plan::Plan& plan, const std::string& path,
                                              const object::Reading& reading);

/// @throws InputError  the plan is for another dimension, another object (unless that is allowed),
/// or
///                     another scale.
void CheckPlanFits(const plan::Plan& plan, const object::ObjectFile& object,
                   const PlanAndObject& given);

}  // namespace regrasp::apps
