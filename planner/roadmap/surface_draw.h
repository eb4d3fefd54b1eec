#pragma once

#include <string>

#include "planner/base/random.h"
#include "planner/graph/grasp_judge.h"
#include "planner/object/polyhedron.h"

namespace regrasp {

/// A grasp of contacts spread evenly over the surface, as good as `judge` asks.
/// @param name  how messages call it.
/// @throws NoGrasp  none of kMaxSurfaceDraws draws serves.
[[nodiscard]] Grasp DrawOnSurface(const Polyhedron& solid, int contacts, const GraspJudge& judge,
                                  RandomStream& random, const std::string& name);

}  // namespace regrasp
