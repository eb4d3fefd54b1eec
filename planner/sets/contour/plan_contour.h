#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string_view>

#include "planner/base/deadline.h"
#include "planner/object/polygon.h"
#include "planner/planning/grasp_choice.h"
#include "planner/planning/plan_result.h"
#include "planner/sets/contour/sequence_builder.h"

namespace regrasp {

struct ContourPlanOptions {
  double half_angle = 0;  ///< friction, radians in (0, π/2)
  std::uint64_t seed = 0;
  /// Quality that random grasps have at least, and the sequence's grasps where there is a way.
  double min_quality = 0.01;
  SwitchObjective aim = SwitchObjective::kRoom;
  /// Told what is being done.
  std::function<void(std::string_view)> progress = [](std::string_view) {};
  double finger_radius = 0;  ///< of fingers that are not points (reach.h)
  /// Bytes that the graph and its sets may take; where they would take more there is no plan.
  double memory = std::numeric_limits<double>::infinity();
  /// When there is no plan, unless one of lower quality was found.
  Deadline deadline = {};
};

/// Plans a sequence of switches and aligns from one 2-finger grasp to another on the switching
/// graph of a polygon's whole boundary (Phoka 2010, chapter IV), with a hand of kContourFingers
/// fingers.
///
/// Among the paths with the fewest switches the one through the widest sets is taken. Where a
/// switch's grasps are below `min_quality`, paths without it are tried; where there is none, a
/// warning names the weakest step. Contacts that a switch places carry the half-width of the
/// smaller contact region of its two grasps, rounded down.
///
/// Laws: the same arguments give the same plan, bit for bit; a goal equal to the start as a set
/// gives no steps; every grasp at rest and on the way is force closure; along the same path of sets
/// SwitchObjective::kRegion gives every switch a region at least as large as SwitchObjective::kRoom
/// does.
/// @throws InputError             a given grasp does not serve (CheckGivenGrasp).
/// @throws std::invalid_argument  an option is out of its range.
[[nodiscard]] PlanResult PlanOnContour(const Polygon& polygon, const GraspChoice& start,
                                       const GraspChoice& goal, const ContourPlanOptions& options);

}  // namespace regrasp
