#pragma once

#include <optional>
#include <span>
#include <string>

#include "planner/motion/find_motion_proof.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "planner/plan/reason.h"

namespace regrasp::plan {

/// Obstacle of fingers, as text for messages and as a fault for an image.
struct Obstacle {
  std::string detail;
  Fault fault;
};

/// Functions that return the obstacle of fingers of some radius (reach.h) in a plan; nullopt if
/// there is none. Contacts are on the object and have faces. Fingers with a radius of 0 or less are
/// points, for which only sealed cavities are unreachable.

/// Find an obstacle of a static grasp.
/// It is a contact out of reach of its finger, or an overlap of two fingers.
[[nodiscard]] std::optional<Obstacle> FindRestObstacle(const object::Object& object,
                                                       const FingerGrasp& grasp, double radius);

/// Find an obstacle of a step that begins with `before`.
/// In a finger switch all fingers are in contact together before those of `release` leave. In a
/// sliding step every waypoint counts as a static grasp, and the moving fingers must be free of
/// obstacles between waypoints too. Bisection decides this, with bounds on how far the fingers
/// move, down to kShortestReachInterval of the path; shorter undecided intervals pass.
[[nodiscard]] std::optional<Obstacle> FindStepObstacle(const object::Object& object,
                                                       const FingerGrasp& before, const Step& step,
                                                       double radius);

inline constexpr double kShortestReachInterval = 1e-3;

struct PlanObstacle {
  EntryIndex index{0};
  std::string detail;
};

/// Find the first obstacle of a sequence of steps.
[[nodiscard]] std::optional<PlanObstacle> FindPlanObstacle(const object::Object& object,
                                                           const FingerGrasp& initial,
                                                           std::span<const Step> steps,
                                                           double radius);

}  // namespace regrasp::plan
