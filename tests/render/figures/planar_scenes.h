#pragma once

#include <string>
#include <vector>

#include "planner/object/polygon.h"
#include "planner/plan/plan.h"
#include "tests/fixtures/polygons.h"

namespace regrasp::render {

[[nodiscard]] plan::FingerContact FingerAt(const object::Polygon& polygon, int finger, int edge,
                                           double share);

/// A plan of a hand of four fingers at θ = 20°; its goal is the last grasp.
[[nodiscard]] plan::Plan MakePlanarPlan(const plan::FingerGrasp& initial,
                                        std::vector<plan::Step> steps);

/// A plan on the square at θ = 20°: a parallel grasp; finger 0 moves; 3 takes over from 0; 0 is
/// placed opposite and 1 and 2 leave.
[[nodiscard]] plan::Plan MakeSquarePlan();

/// A hold and a switch on the triangle at θ = 20°, both concurrent.
[[nodiscard]] plan::Plan MakeTrianglePlan();

}  // namespace regrasp::render
