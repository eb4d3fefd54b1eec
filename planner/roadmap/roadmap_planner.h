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
#include "planner/roadmap/contact_chain.h"

namespace regrasp::roadmap {

/// What a roadmap takes at most while it is built and searched, within a factor of two: the larger
/// of the two that its options ask for, the clustering of its contact points, which goes with the
/// square of their number, and its force-closure grasps, which go with the fourth power of the
/// number of contact points or representatives and not with the size of the mesh.
///
/// The share of force-closure grasps is that of grasps drawn evenly over the surface. What a grasp
/// takes was measured: at the limits, kMaxRoadmapContacts and kMostClusters, 0.7 to 4 GB, and 0.5
/// GB for kMaxClusteredContacts.
///
/// Law: the same solid and options give the same number.
[[nodiscard]] MemoryNeed EstimateRoadmap(const planning::PlanRequest& request);

/// A force-closure grasp of four of the contact points, all of them equally likely; nullopt where
/// none of kMaxSurfaceDraws draws is one.
/// @param evaluator  of the roadmap's solid and half-angle.
[[nodiscard]] std::optional<Quadruple> DrawContactGrasp(const ClusteredRoadmap& roadmap,
                                                        const criteria::GraspEvaluator& evaluator,
                                                        RandomStream& random);

/// A query between two random force-closure grasps, and the time that it took.
struct RandomQuery {
  Quadruple start;
  Quadruple goal;
  ContactChain chain;
  double seconds = 0;
};

/// Queries between force-closure grasps drawn from all contact points, joined or not, as in tables
/// 6.1 to 6.6 of Phoka 2010. The same seed gives the same queries whatever the clusters.
/// @param solid  of the roadmap.
/// @returns fewer than `count` where grasps can't be drawn.
/// @param tell  told how many are done.
/// @throws TimeUp  the deadline came.
[[nodiscard]] std::vector<RandomQuery> RunRandomQueries(const ClusteredRoadmap& roadmap,
                                                        const object::Polyhedron& solid, int count,
                                                        std::uint64_t seed, bool last_resort,
                                                        const Deadline& deadline = {},
                                                        const Tell& tell = {});

/// Plans finger switches between grasps of four contact points of a solid (Phoka 2010, chapter VI),
/// with a hand of kRoadmapFingers fingers: of these grasps it knows every one and every switch.
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
