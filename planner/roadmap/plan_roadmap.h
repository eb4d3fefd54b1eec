#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/graph/grasp_choice.h"
#include "planner/graph/plan_result.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "planner/roadmap/roadmap.h"

namespace regrasp {

/// Fingers of the hand: four hold, the fifth switches.
inline constexpr int kRoadmapFingers = 5;
/// More contact points than this need more memory than a small machine has: 65 million subsets.
inline constexpr int kMaxRoadmapContacts = 200;

struct RoadmapOptions {
  double half_angle = 0;  ///< friction, radians in (0, π/2)
  int contacts = 60;      ///< points spread over the surface, 4 … kMaxRoadmapContacts
  std::uint64_t seed = 0;
  /// Quality that random grasps have at least, and the sequence's grasps where there is a way.
  double min_quality = 0.01;
  /// Told what is being done.
  std::function<void(std::string_view)> progress = [](std::string_view) {};
};

struct RoadmapPlanResult : PlanResult {
  int contact_points = 0;  ///< those given and those spread
  int vertices = 0;        ///< force-closure grasps of four of them
  int quality_tests = 0;   ///< grasps that the search asked for their quality
  int margin_tests = 0;    ///< and for their margin
};

/// The contact points, start's and goal's first, tested for force closure in all fours.
[[nodiscard]] Roadmap BuildRoadmap(const Polyhedron& solid, const RoadmapOptions& options,
                                   const std::vector<Contact>& joined = {});

/// Plans a sequence of finger switches from start to goal on the plain roadmap: the fewest switches
/// first, then the largest smallest margin to the required half-angle. Grasps below `min_quality`
/// are passed only where there is no other way, and then a warning names the weakest step.
///
/// Laws: the same arguments give the same plan, bit for bit; a goal equal to the start as a set
/// gives no steps.
/// @throws InputError  a given grasp does not serve (CheckGivenGrasp).
/// @throws std::invalid_argument  an option is out of its range.
[[nodiscard]] RoadmapPlanResult PlanOnRoadmap(const Polyhedron& solid, const GraspChoice& start,
                                              const GraspChoice& goal,
                                              const RoadmapOptions& options);

}  // namespace regrasp
