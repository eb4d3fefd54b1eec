#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <vector>

#include "planner/base/number.h"
#include "planner/object/polyhedron.h"
#include "planner/sets/polyhedron/polyhedron_graph.h"

namespace regrasp::polyhedron {

/// A solid with a name for messages.
struct NamedBody {
  std::string name;
  object::Polyhedron body;
};

inline constexpr planning::Spanning kBothSpannings[] = {planning::Spanning::kUniform,
                                                        planning::Spanning::kAdaptive};

[[nodiscard]] const char* Name(planning::Spanning spanning);

/// Vertices of a cube with every second corner: edges of 2√2, the centre at the origin.
[[nodiscard]] object::Polyhedron RegularTetrahedron();

/// The ends of the three unit axes.
[[nodiscard]] object::Polyhedron RegularOctahedron();

/// About the origin.
[[nodiscard]] object::Polyhedron Box(const Eigen::Vector3d& size);

using Ring = std::vector<Eigen::Vector2d>;

/// The part between z = 0 and z = `height` of the cone over an outline (counter-clockwise, then
/// holes, clockwise) whose copy at the top is `taper` times as large about the origin: its two ends
/// have the outline's shape, holes go through.
[[nodiscard]] object::Polyhedron Frustum(const std::vector<Ring>& rings, double height,
                                         double taper);

/// An L about the origin, and a square with a square hole.
[[nodiscard]] std::vector<Ring> LOutline();
[[nodiscard]] std::vector<Ring> FrameOutline();

/// The like without parallel edges, so that the sides of frusta hold grasps with the ends: a
/// boomerang, and a pentagon with a triangular hole.
[[nodiscard]] std::vector<Ring> BoomerangOutline();
[[nodiscard]] std::vector<Ring> RingOutline();

/// A tetrahedron, round and stretched stones, frusta of a boomerang and of a ring: few faces, none
/// of them with a symmetry, convex and not.
[[nodiscard]] const std::vector<NamedBody>& SmallBodies();

/// Calls check(body, degrees, spanning) for each of the small bodies, the angles and both
/// spannings.
template <class Check>
void ForEachSmallBody(std::span<const double> angles, const Check& check) {
  for (const NamedBody& named : SmallBodies()) {
    for (const double degrees : angles) {
      for (const planning::Spanning spanning : kBothSpannings) {
        SCOPED_TRACE(named.name + " " + std::to_string(degrees) + " " + Name(spanning));
        check(named.body, degrees, spanning);
      }
    }
  }
}

}  // namespace regrasp::polyhedron
