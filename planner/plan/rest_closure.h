#pragma once

#include <optional>

#include "planner/grasp/required_half_angle.h"
#include "planner/object/wrench_frame.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// Force closure of the grasps at rest of a plan, one after the other: what one step ends with the
/// next one begins with, and is not decided twice.
class RestClosure {
 public:
  struct Found {
    bool holds = false;
    /// No larger than the friction where the grasp holds; nullopt where no half-angle is enough.
    std::optional<grasp::RequiredHalfAngle> required;
  };

  /// @param half_angle  friction, radians.
  RestClosure(const object::WrenchFrame& frame, double half_angle)
      : frame_(frame), half_angle_(half_angle) {}

  /// @param grasp  located, or without contacts: it does not hold then.
  [[nodiscard]] const Found& Of(const FingerGrasp& grasp);

 private:
  object::WrenchFrame frame_;
  double half_angle_;
  FingerGrasp last_;
  Found found_;  ///< of that
};

}  // namespace regrasp::plan
