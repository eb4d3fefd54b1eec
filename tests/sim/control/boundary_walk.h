#pragma once

#include <vector>

#include "tests/sim/planar_cases.h"

namespace regrasp::sim {

/// A finger that goes along the boundary: from a share of an edge by a length, counter-clockwise
/// about the material where that is positive.
struct Walk {
  int finger = 0;
  int edge = 0;
  double share = 0;
  double length = 0;
};

/// The align in which all fingers walk at constant rates, with two waypoints wherever one of them
/// gets to a vertex: before and after its normal turns.
[[nodiscard]] plan::Align WalkBoundary(const object::Polygon& polygon,
                                       const std::vector<Walk>& walks);

/// A hand of three fingers that holds with two of them and aligns.
[[nodiscard]] plan::Plan MakeWalkPlan(const object::Polygon& polygon,
                                      const std::vector<Walk>& walks, double half_angle_deg);

/// How often a finger turns at a vertex in an align.
[[nodiscard]] int CountTurns(const plan::Align& align);

/// Of discs, gears and rings, metres.
inline constexpr double kDiscRadius = 0.05;

/// As many teeth, each of two edges: every other corner is concave. `depth` over the
/// radius.
[[nodiscard]] object::Polygon MakeGear(int teeth, double depth);

/// A disc with a round hole of 60 % of its radius: the first edges are the outer ones, and the k-th
/// edge of the hole lies at the same angle as the k-th last edge of the disc.
[[nodiscard]] object::Polygon MakeRing(int edges);

/// A smooth irregular outline, its vertices at uneven distances: long and very short edges, convex
/// and concave corners and almost straight ones.
[[nodiscard]] object::Polygon DrawOutline(int edges, std::mt19937& random);

}  // namespace regrasp::sim
