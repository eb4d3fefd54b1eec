#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/base/counted_progress.h"
#include "planner/base/deadline.h"
#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/object/polyhedron.h"
#include "planner/roadmap/contact_chain.h"

namespace regrasp::roadmap {

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

}  // namespace regrasp::roadmap
