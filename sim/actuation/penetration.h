#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "planner/collision/convex_shape.h"
#include "planner/collision/surface_tree.h"
#include "planner/object/polyhedron.h"

namespace regrasp::sim {

/// Depth of convex shapes in a solid. All quantities are in the solid's frame, metres.
///
/// The depth is the length of the shortest translation that moves the shape out of the solid. The
/// candidates are the known surface normal near the shape and 26 evenly distributed directions. The
/// depth is exact along the normal and at most an eighth too large otherwise.
class Penetration {
 public:
  /// @param scale  metres per unit of the solid's file.
  Penetration(const object::Polyhedron& solid, double scale);

  [[nodiscard]] const collision::SurfaceTree& surface() const { return surface_; }

  /// Return whether a shape is deeper in the solid than `depth`.
  /// @param outward  outward unit normal of the surface near the shape; zero if the surface is not
  ///     near.
  [[nodiscard]] bool IsDeeper(const collision::ConvexShape& shape, double depth,
                              const Eigen::Vector3d& outward) const;
  /// Return the depth of a shape, at most `most`, rounded up to 0.05 mm.
  [[nodiscard]] double Depth(const collision::ConvexShape& shape, double most,
                             const Eigen::Vector3d& outward) const;
  [[nodiscard]] bool Contains(const Eigen::Vector3d& point) const;

 private:
  [[nodiscard]] bool IsOutAfter(const collision::ConvexShape& shape,
                                const Eigen::Vector3d& way) const;

  collision::SurfaceTree surface_;
  std::vector<std::array<Eigen::Vector3d, 3>> triangles_;
  Eigen::AlignedBox3d box_;
};

}  // namespace regrasp::sim
