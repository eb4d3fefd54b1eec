#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "planner/planning/grasp_choice.h"
#include "planner/planning/plan_result.h"
#include "planner/roadmap/clustered_roadmap.h"
#include "planner/roadmap/roadmap.h"

namespace regrasp {

/// Fingers of the hand: four hold, the fifth switches.
inline constexpr int kRoadmapFingers = 5;
/// Contact points of a plain roadmap: more need more memory than a small machine has, 65 million
/// subsets.
inline constexpr int kMaxRoadmapContacts = 200;
/// Contact points of a clustered one: their affinities take 8 N² bytes three times over.
inline constexpr int kMaxClusteredContacts = 4000;

struct RoadmapOptions {
  double half_angle = 0;  ///< friction, radians in (0, π/2)
  /// Contact points: 4 … kMaxRoadmapContacts, with clusters … kMaxClusteredContacts.
  int contacts = 60;
  int clusters = 0;         ///< of the contact points; 0: none, all subsets of four are looked at
  bool last_resort = true;  ///< of a clustered roadmap (FindContactChain)
  std::uint64_t seed = 0;
  /// Quality that random grasps have at least, and the sequence's grasps where there is a way.
  double min_quality = 0.01;
  /// Told what is being done.
  std::function<void(std::string_view)> progress = [](std::string_view) {};
  /// Of fingers that are not points (reach.h): contact points that they cannot reach are left out,
  /// and those where two would overlap are never held together.
  double finger_radius = 0;
  /// Bytes that a roadmap may take; where it would take more there is no plan (EstimateRoadmap).
  double memory = std::numeric_limits<double>::infinity();
  /// When there is no plan.
  Deadline deadline = {};
};

struct RoadmapPlanResult : PlanResult {
  int contact_points = 0;  ///< those given and those spread
  int vertices = 0;        ///< force-closure grasps of four of them
  int quality_tests = 0;   ///< grasps that the search asked for their quality
  int margin_tests = 0;    ///< and for their margin
};

/// How many contact points and clusters a roadmap gets where they are left open: 60 points and no
/// clusters on a body of at most kMaxRoadmapContacts faces; 1000 points in 50 clusters on one of
/// more, a mesh. Contact points that are asked for decide in place of the faces.
struct RoadmapSize {
  int contacts = 0;
  int clusters = 0;
};
[[nodiscard]] RoadmapSize ChooseRoadmapSize(const Polyhedron& solid, std::optional<int> contacts,
                                            std::optional<int> clusters);

/// The contact points, start's and goal's first, tested for force closure in all fours.
[[nodiscard]] Roadmap BuildRoadmap(const Polyhedron& solid, const RoadmapOptions& options,
                                   const std::vector<Contact>& joined = {});

/// The roadmap of representatives that `options.clusters` asks for.
[[nodiscard]] ClusteredRoadmap BuildClusteredRoadmap(const Polyhedron& solid,
                                                     const RoadmapOptions& options);

/// Plans a sequence of finger switches from start to goal. On a plain roadmap: the fewest switches
/// first, then the largest smallest margin to the required half-angle. Grasps below `min_quality`
/// are passed only where there is no other way, and then a warning names the weakest step.
///
/// On a clustered roadmap FindContactChain looks for a sequence, and the contacts of the one that
/// it finds are the contact points of a plain roadmap, which shortens and widens it.
///
/// Laws: the same arguments give the same plan, bit for bit; a goal equal to the start as a set
/// gives no steps.
/// @throws InputError  a given grasp does not serve (CheckGivenGrasp).
/// @throws std::invalid_argument  an option is out of its range.
[[nodiscard]] RoadmapPlanResult PlanOnRoadmap(const Polyhedron& solid, const GraspChoice& start,
                                              const GraspChoice& goal,
                                              const RoadmapOptions& options);

/// The same on a plain roadmap of these contact points and those of start and goal.
[[nodiscard]] RoadmapPlanResult PlanOverContacts(const Polyhedron& solid,
                                                 const std::vector<Contact>& contacts,
                                                 const GraspChoice& start, const GraspChoice& goal,
                                                 const RoadmapOptions& options);

}  // namespace regrasp
