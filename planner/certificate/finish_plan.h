#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/check.h"
#include "planner/plan/plan.h"

namespace regrasp::certificate {

/// What a plan says of where it comes from, besides what the planner knows.
struct PlanOrigin {
  double half_angle = 0;                                ///< of the friction that is there, radians
  double scale = 1;                                     ///< metres per unit of the object
  std::optional<object::Shells> shells = std::nullopt;  ///< as it was read with
  std::optional<double> patch_radius = std::nullopt;    ///< of what a fingertip feels, its unit
  /// Of contacts at these points only; outlives the call.
  const std::vector<Eigen::Vector3d>* given_points = nullptr;
};

/// Makes a planner's plan one that stands alone: says what it is a plan for, adds the proofs of its
/// aligns, and asks the checker.
/// @returns what the checker says; a plan that it fails is a defect of the planner.
[[nodiscard]] plan::PlanCheck FinishPlan(const object::ObjectFile& object, const PlanOrigin& origin,
                                         plan::Plan& plan);

}  // namespace regrasp::certificate
