#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/object/polygon.h"
#include "planner/plan/plan.h"
#include "render/figures/grasp_diagram.h"
#include "tests/fixtures/polygons.h"

namespace regrasp::render {

/// Return a disc with a concentric round hole of half its radius and the same number of edges.
[[nodiscard]] object::Polygon MakeRing(int edges);

/// Return an upright fork, 10 wide and 10 high, with prongs of width 3 and a slot 4 wide and 7
/// deep.
///
/// Boundary lengths: bottom 0 to 10, right side to 20, right end to 23, right inner side to 30,
/// floor of the slot to 34, left inner side to 41, left end to 44, left side to 54.
[[nodiscard]] object::Polygon MakeFork();

/// Return a plan with θ = 20° and all contacts 2 below the ends. The first grasp holds both sides,
/// the second the right prong, and the third stretches the slot. If a contact that stays keeps its
/// axis, the places are (18, 46), (18, 25) and (39, 25).
[[nodiscard]] plan::Plan MakeForkPlan();

/// Return a plan in which two antipodal contacts slide to the next edges of a disc, one of them
/// from the last edge to the first.
[[nodiscard]] plan::Plan MakeDiscPlan(const object::Polygon& disc);

/// Return a plan that replaces both contacts on a square in one switch.
[[nodiscard]] plan::Plan MakeExchangePlan();

/// Return whether a point is inside a convex counter-clockwise outline or within `margin` of it.
[[nodiscard]] bool Contains(const Outline& outline, const Eigen::Vector2d& p, double margin = 0);

/// Return the number of outlines that contain the point.
[[nodiscard]] int CountContaining(const std::vector<Outline>& outlines, const Eigen::Vector2d& p);

[[nodiscard]] double AreaOf(const std::vector<Outline>& outlines);

}  // namespace regrasp::render
