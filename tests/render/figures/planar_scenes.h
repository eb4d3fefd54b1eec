#pragma once

#include <string>
#include <vector>

#include "planner/object/polygon.h"
#include "planner/plan/plan.h"
#include "tests/fixtures/polygons.h"

namespace regrasp::render {

[[nodiscard]] plan::FingerContact FingerAt(const object::Polygon& polygon, int finger, int edge,
                                           double share);

/// Return a plan for four fingers at θ = 20°. Its goal is the last grasp.
[[nodiscard]] plan::Plan MakePlanarPlan(const plan::FingerGrasp& initial,
                                        std::vector<plan::Step> steps);

/// Return a plan on the square at θ = 20°: a parallel grasp, a sliding step of finger 0, a switch
/// from finger 0 to 3, and a switch that places finger 0 opposite and releases 1 and 2.
[[nodiscard]] plan::Plan MakeSquarePlan();

/// Return a plan with an initial grasp and a switch on the triangle at θ = 20°. Both grasps are
/// concurrent.
[[nodiscard]] plan::Plan MakeTrianglePlan();

}  // namespace regrasp::render
