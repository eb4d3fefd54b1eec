#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string_view>

#include "planner/base/deadline.h"
#include "planner/object/polygon.h"
#include "planner/planning/grasp_choice.h"
#include "planner/planning/plan_result.h"
#include "planner/sets/polygon/grasp_set.h"

namespace regrasp {

struct PolygonPlanOptions {
  double half_angle = 0;  ///< friction, radians in (0, π/2)
  Spanning spanning = Spanning::kAdaptive;
  std::uint64_t seed = 0;
  /// Quality that random grasps have at least, and the sequence's grasps where there is a way.
  double min_quality = 0.01;
  /// Told what is being done.
  std::function<void(std::string_view)> progress = [](std::string_view) {};
  double finger_radius = 0;  ///< of fingers that are not points (reach.h)
  /// Bytes that the graph may take; where it would take more there is no plan.
  double memory = std::numeric_limits<double>::infinity();
  /// When there is no plan, unless one of lower quality was found.
  Deadline deadline = {};
};

/// Plans a sequence of switches and aligns from start to goal on the switching graph of a polygon
/// (Phoka 2010, section 3.4), with a hand of kPolygonFingers fingers.
///
/// A grasp is joined to the sets that contain it, or contain two or three of its contacts: the
/// others are then released first or placed last. Among the paths with the fewest switches the one
/// through the widest sets is taken. Each switch happens where its two grasps have the most slack,
/// unless the grasp at hand or the goal serves nearly as well; between switches the fingers align
/// along straight lines inside the set. Where a switch's best grasps are below `min_quality`, paths
/// without it are tried; where there is none, a warning names the weakest step.
///
/// Laws: the same arguments give the same plan, bit for bit; a goal equal to the start as a set
/// gives no steps; every grasp at rest and on the way is force closure.
/// @throws InputError             a given grasp does not serve (CheckGivenGrasp).
/// @throws std::invalid_argument  an option is out of its range.
[[nodiscard]] PlanResult PlanOnPolygon(const Polygon& polygon, const GraspChoice& start,
                                       const GraspChoice& goal, const PolygonPlanOptions& options);

}  // namespace regrasp
