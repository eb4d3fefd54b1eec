#pragma once

#include <functional>
#include <string>

#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/object/polyhedron.h"

namespace regrasp {

/// A grasp of contacts spread evenly over the surface, as good as `judge` asks.
/// @param name         how messages call it.
/// @param before_draw  may throw to make an end.
/// @throws NoGrasp  none of kMaxSurfaceDraws draws serves.
[[nodiscard]] Grasp DrawOnSurface(
    const Polyhedron& solid, int contacts, const GraspEvaluator& evaluator, RandomStream& random,
    const std::string& name, const std::function<void()>& before_draw = [] {});

}  // namespace regrasp
