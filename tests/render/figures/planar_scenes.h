#pragma once

#include <string>
#include <vector>

#include "planner/object/polygon.h"
#include "planner/plan/plan.h"

namespace regrasp {

[[nodiscard]] Polygon MakeTriangle();  ///< equilateral, side 1, one edge on the x axis from 0 to 1
[[nodiscard]] Polygon MakeSquare();    ///< [−1, 1]²; edges: bottom, right, top, left

/// The contact at `u` of the way along an edge.
[[nodiscard]] Contact ContactAt(const Polygon& polygon, int edge, double u);
[[nodiscard]] FingerContact FingerAt(const Polygon& polygon, int finger, int edge, double u);

/// A plan on the square at θ = 20°: a parallel grasp; finger 0 moves; 3 takes over from 0; 0 is
/// placed opposite and 1 and 2 leave.
[[nodiscard]] Plan MakeSquarePlan();

/// A hold and a switch on the triangle at θ = 20°, both concurrent.
[[nodiscard]] Plan MakeTrianglePlan();

}  // namespace regrasp
