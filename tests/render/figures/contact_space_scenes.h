#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/object/polygon.h"
#include "planner/plan/plan.h"
#include "render/figures/grasp_diagram.h"
#include "tests/fixtures/polygons.h"

namespace regrasp::render {

/// A disc with a concentric round hole of half its radius, of as many edges.
[[nodiscard]] object::Polygon MakeRing(int edges);

/// An upright fork, 10 wide and 10 high; prongs 3 wide, the slot 4 wide and 7 deep. Its boundary by
/// length: bottom 0 to 10, right side to 20, right tip to 23, right inner side to 30, floor of the
/// slot to 34, left inner side to 41, left tip to 44, left side to 54.
[[nodiscard]] object::Polygon MakeFork();

/// At θ = 20°, all 2 below the tips: both sides are squeezed; then the right prong; then the slot
/// is stretched. Places (18, 46), (18, 25), (39, 25) if a contact that stays keeps its axis.
[[nodiscard]] plan::Plan MakeForkPlan();

/// Two antipodal contacts move to the next edges of a disc, one of them from the last to the first.
[[nodiscard]] plan::Plan MakeDiscPlan(const object::Polygon& disc);

/// A square whose both contacts are exchanged at once.
[[nodiscard]] plan::Plan MakeExchangePlan();

/// True iff a point is inside a convex counter-clockwise outline, or within `margin` of it.
[[nodiscard]] bool Contains(const Outline& outline, const Eigen::Vector2d& p, double margin = 0);

/// How many of the outlines contain the point.
[[nodiscard]] int CountContaining(const std::vector<Outline>& outlines, const Eigen::Vector2d& p);

[[nodiscard]] double AreaOf(const std::vector<Outline>& outlines);

}  // namespace regrasp::render
