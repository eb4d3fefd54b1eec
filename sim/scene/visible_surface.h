#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "planner/object/object.h"

namespace regrasp::sim {

/// The true surface of the body that is simulated, for the eye.
struct VisibleSurface {
  std::vector<Eigen::Vector3d> vertices;      ///< the object's own frame and units
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise from outside
};

/// A solid's own surface; a polygon's prism of the height `thickness` about the plane z = 0.
[[nodiscard]] VisibleSurface MakeVisibleSurface(const object::Object& object, double thickness);

}  // namespace regrasp::sim
