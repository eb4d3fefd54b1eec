#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/in_blocks.h"
#include "planner/base/memory.h"
#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/object/polyhedron.h"
#include "planner/planning/plan_request.h"
#include "planner/planning/planner.h"
#include "planner/roadmap/local_planners.h"

namespace regrasp::roadmap {

/// Estimate the peak memory of building and searching a roadmap, within a factor of two.
/// It is the larger one of two estimates. The clustering of contact points is quadratic in their
/// number. The force-closure grasps grow with the fourth power of the number of contact points or
/// representatives, and are independent of the size of the mesh.
///
/// The share of force-closure grasps is estimated from grasps drawn uniformly over the surface. The
/// memory per grasp was measured: at the limits kMaxRoadmapContacts and kMostClusters a roadmap
/// requires 0.7 to 4 GB. kMaxClusteredContacts requires 0.5 GB.
///
/// Law: equal solids and options give equal estimates.
[[nodiscard]] MemoryNeed EstimateRoadmap(const planning::PlanRequest& request);

/// Draw a force-closure grasp of four contact points, uniformly.
/// @param evaluator  evaluator for the roadmap's solid and friction angle.
/// @returns nullopt if none of kMaxSurfaceDraws grasps is force closure.
[[nodiscard]] std::optional<Quadruple> DrawContactGrasp(const ClusteredRoadmap& roadmap,
                                                        const criteria::GraspEvaluator& evaluator,
                                                        RandomStream& random);

/// Query between two random force-closure grasps, with its duration.
struct RandomQuery {
  Quadruple start;
  Quadruple goal;
  ContactChain chain;
  double seconds = 0;
};

/// Run queries between random force-closure grasps of all contact points.
/// They correspond to tables 6.1 to 6.6 of Phoka 2010.
/// Equal seeds give equal queries, whatever the clusters.
/// @param solid  solid of the roadmap.
/// @returns solved and unsolved queries; fewer than `count` if no grasps can be drawn.
/// @throws TimeUp  if the deadline passes.
[[nodiscard]] std::vector<RandomQuery> RunRandomQueries(const ClusteredRoadmap& roadmap,
                                                        const object::Polyhedron& solid, int count,
                                                        std::uint64_t seed, bool last_resort,
                                                        const Deadline& deadline = {},
                                                        const Tell& tell = {});

/// Planner of finger switches between grasps of four contact points of a solid.
/// The method is that of Phoka 2010, chapter 6.
/// The hand has kRoadmapFingers fingers. The roadmap contains all such grasps and all switches
/// between them.
class RoadmapPlanner final : public planning::Planner {
 public:
  RoadmapPlanner();
  [[nodiscard]] std::optional<MemoryNeed> EstimateMemory(
      const planning::PlanRequest& request) const override;
  [[nodiscard]] planning::PlanResult Plan(const planning::PlanRequest& request) const override;
  [[nodiscard]] planning::GraphSummary SummarizeGraph(
      const planning::PlanRequest& request) const override;
};

}  // namespace regrasp::roadmap
