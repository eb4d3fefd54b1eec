#pragma once

#include <optional>
#include <span>
#include <string>

#include "planner/motion/contact_motion.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "planner/plan/reason.h"

namespace regrasp::plan {

/// What is in the way of fingers, in words for people and for a picture.
struct Obstacle {
  std::string detail;
  Fault fault;
};

/// What obstructs fingers of some radius (reach.h) in a plan; nullopt where nothing does. Contacts
/// lie on the object and know their faces; to fingers of a radius of 0 or less, which are points,
/// only sealed cavities are closed.

/// Of a grasp at rest: a contact that its finger cannot reach, or two fingers that overlap.
[[nodiscard]] std::optional<Obstacle> FindRestObstacle(const object::Object& object,
                                                       const FingerGrasp& grasp, double radius);

/// Of a step that begins with `before`. In a switch all fingers hold together before those of
/// `release` leave. In an align every waypoint counts as a rest, and on the path between two of
/// them nothing may obstruct the moving fingers either: decided by bisection with bounds on how far
/// they move, down to kShortestReachInterval of the path; what stays undecided there passes.
[[nodiscard]] std::optional<Obstacle> FindStepObstacle(const object::Object& object,
                                                       const FingerGrasp& before, const Step& step,
                                                       double radius);

inline constexpr double kShortestReachInterval = 1e-3;

struct PlanObstacle {
  EntryIndex index{0};
  std::string detail;
};

/// The first in a sequence.
[[nodiscard]] std::optional<PlanObstacle> FindPlanObstacle(const object::Object& object,
                                                           const FingerGrasp& initial,
                                                           std::span<const Step> steps,
                                                           double radius);

}  // namespace regrasp::plan
