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

/// Make a tetrahedron of every second corner of a cube: edges of 2√2, centre at the origin.
[[nodiscard]] object::Polyhedron RegularTetrahedron();

/// Make an octahedron of the ends of the three unit axes.
[[nodiscard]] object::Polyhedron RegularOctahedron();

/// Make a box about the origin.
[[nodiscard]] object::Polyhedron Box(const Eigen::Vector3d& size);

using Ring = std::vector<Eigen::Vector2d>;

/// Make the part of a cone over an outline between z = 0 and z = `height`.
///
/// The outline (counter-clockwise, then holes, clockwise) is `taper` times as large at the top,
/// about the origin. Both ends have its shape, and holes pass through.
[[nodiscard]] object::Polyhedron Frustum(const std::vector<Ring>& rings, double height,
                                         double taper);

/// Outlines of an L about the origin, and of a square with a square hole.
[[nodiscard]] std::vector<Ring> LOutline();
[[nodiscard]] std::vector<Ring> FrameOutline();

/// Similar outlines without parallel edges: a boomerang, and a pentagon with a triangular hole. The
/// sides and ends of their frusta therefore permit grasps.
[[nodiscard]] std::vector<Ring> BoomerangOutline();
[[nodiscard]] std::vector<Ring> RingOutline();

/// Return objects with few faces and without symmetry, convex or not: a tetrahedron, round and
/// stretched stones, frusta of a boomerang and of a ring.
[[nodiscard]] const std::vector<NamedBody>& SmallBodies();

/// Call check(body, degrees, spanning) for each small object, angle and spanning rule.
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
