#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "planner/object/polyhedron.h"

namespace regrasp::collision {

/// A point of a surface that is near a ball.
struct NearPoint {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d outward = Eigen::Vector3d::UnitZ();  ///< from the point to the ball's centre
  double distance = 0;                                 ///< to the centre
};

/// Where balls touch the true surface of a solid, faceted and not convex as it may be: the engine
/// collides convex shapes only, and finds contacts of meshes to a tolerance.
class BallContact {
 public:
  /// @param scale  metres per unit of the solid.
  BallContact(const object::Polyhedron& solid, double scale);

  /// The points where the distance from `centre` is a local minimum over the surface and at most
  /// `reach`, nearest first: one over a face or an edge, two in a groove. Of triangles that face
  /// away nothing is told: the centre is outside, or in the surface by less than the ball's radius.
  /// @param centre  in the solid's frame, metres.
  [[nodiscard]] std::vector<NearPoint> Find(const Eigen::Vector3d& centre, double reach) const;
  /// The same where it is known which triangles can be that near (Around), as those of a ball that
  /// has moved little.
  [[nodiscard]] std::vector<NearPoint> Find(const Eigen::Vector3d& centre, double reach,
                                            const std::vector<int>& among) const;
  /// Triangles that may be within `reach` of `centre`, in their order.
  [[nodiscard]] std::vector<int> Around(const Eigen::Vector3d& centre, double reach) const;

  /// Of a triangle, metres, counter-clockwise from outside.
  [[nodiscard]] const std::array<Eigen::Vector3d, 3>& corners(int triangle) const {
    return triangles_[triangle].corners;
  }
  /// Outward and unit.
  [[nodiscard]] const Eigen::Vector3d& normal(int triangle) const {
    return triangles_[triangle].normal;
  }
  /// The point of a triangle that is nearest to a point.
  [[nodiscard]] Eigen::Vector3d ClosestOn(int triangle, const Eigen::Vector3d& point) const;

 private:
  struct Triangle {
    std::array<Eigen::Vector3d, 3> corners;
    Eigen::Vector3d normal;
    Eigen::Vector3d middle;
    double radius;  ///< of a ball about the middle
  };
  std::vector<Triangle> triangles_;
};

}  // namespace regrasp::collision
