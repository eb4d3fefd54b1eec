#pragma once

#include <vector>

#include "tests/sim/planar_cases.h"

namespace regrasp::sim {

/// Walk of a finger along the boundary.
/// It starts at a share of an edge and moves by a length, counter-clockwise about the material if
/// positive.
struct Walk {
  int finger = 0;
  int edge = 0;
  double share = 0;
  double length = 0;
};

/// Return the sliding step in which all fingers walk at constant rates. When a finger reaches a
/// vertex there are two waypoints: before and after its normal turns.
[[nodiscard]] plan::Align WalkBoundary(const object::Polygon& polygon,
                                       const std::vector<Walk>& walks);

/// Return a plan for a hand of three fingers, two of which hold the object and slide.
[[nodiscard]] plan::Plan MakeWalkPlan(const object::Polygon& polygon,
                                      const std::vector<Walk>& walks, double friction_angle_deg);

/// Return the number of turns at vertices in a sliding step.
[[nodiscard]] int CountTurns(const plan::Align& align);

/// Radius of discs, gears and rings, m.
inline constexpr double kDiscRadius = 0.05;

/// Return a gear with `teeth` teeth of two edges each: every other corner is concave.
/// @param depth  depth of the teeth over the radius.
[[nodiscard]] object::Polygon MakeGear(int teeth, double depth);

/// Return a disc with a round hole of 60 % of its radius. The first edges are the outer ones. The
/// k-th edge of the hole is at the same angle as the k-th last edge of the disc.
[[nodiscard]] object::Polygon MakeRing(int edges);

/// Draw a smooth irregular outline with vertices at uneven distances. It has long and very short
/// edges, and convex, concave and almost straight corners.
[[nodiscard]] object::Polygon DrawOutline(int edges, std::mt19937& random);

}  // namespace regrasp::sim
