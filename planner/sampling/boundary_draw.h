#pragma once

#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/grasp/contact.h"
#include "planner/object/polygon.h"
#include "planner/planning/grasp_choice.h"

namespace regrasp {

/// Contacts spread evenly over the boundary of a polygon, where fingers have room; fewer than asked
/// where fingers of a radius (reach.h) reach nearly nothing.
[[nodiscard]] Grasp DrawOnBoundary(const Polygon& polygon, int contacts, RandomStream& random,
                                   double finger_radius = 0);

/// A random grasp of the boundary that is as good as `judge` asks, of two contacts or of three by
/// the seed; where the polygon has none of that number, of the other.
/// @param least, most  2 and 3, or the same twice.
/// @param before_draw  may throw to make an end.
/// @returns nullopt where none of `kMaxSurfaceDraws` draws of each number serves. Two contacts are
///          not drawn where no two edges are opposed enough for any.
[[nodiscard]] std::optional<Grasp> DrawAnyGrasp(
    const Polygon& polygon, int least, int most, const GraspEvaluator& evaluator,
    RandomStream& random, const std::function<void()>& before_draw = [] {});

}  // namespace regrasp
