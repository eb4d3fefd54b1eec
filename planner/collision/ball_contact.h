#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "planner/object/polyhedron.h"

namespace regrasp::collision {

/// Point of a surface near a sphere.
struct NearPoint {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d outward = Eigen::Vector3d::UnitZ();  ///< unit vector to the sphere's centre
  double distance = 0;                                 ///< distance to the sphere's centre
};

/// Contacts of spheres with the exact surface of a solid, which can be non-convex.
/// MuJoCo is not used for this because it collides convex shapes only, and finds mesh contacts to a
/// tolerance.
class BallContact {
 public:
  /// @param solid  solid in object units.
  /// @param scale  metres per object unit.
  BallContact(const object::Polyhedron& solid, double scale);

  /// Return the points nearest to a sphere's centre, nearest first.
  /// At these points the distance from `centre` is a local minimum over the surface and at most
  /// `reach`.
  /// There is one such point over a face or an edge, and two in a groove. Triangles that face away
  /// are ignored: the centre must be outside, or inside by less than the sphere's radius.
  /// @param centre  centre in the solid's frame, metres.
  [[nodiscard]] std::vector<NearPoint> Find(const Eigen::Vector3d& centre, double reach) const;
  /// Return the same points from candidate triangles (result of Around). The candidates can be
  /// reused while a sphere moves little.
  [[nodiscard]] std::vector<NearPoint> Find(const Eigen::Vector3d& centre, double reach,
                                            const std::vector<int>& among) const;
  /// Return the triangles that can be within `reach` of `centre`, in ascending order.
  [[nodiscard]] std::vector<int> Around(const Eigen::Vector3d& centre, double reach) const;

  /// Return the corners of a triangle, counter-clockwise from outside, metres.
  [[nodiscard]] const std::array<Eigen::Vector3d, 3>& corners(int triangle) const {
    return triangles_[triangle].corners;
  }
  /// Return the outward unit normal of a triangle.
  [[nodiscard]] const Eigen::Vector3d& normal(int triangle) const {
    return triangles_[triangle].normal;
  }
  /// Return the point of a triangle nearest to a point.
  [[nodiscard]] Eigen::Vector3d ClosestOn(int triangle, const Eigen::Vector3d& point) const;

 private:
  struct Triangle {
    std::array<Eigen::Vector3d, 3> corners;
    Eigen::Vector3d normal;
    Eigen::Vector3d middle;
    double radius;  ///< radius of a bounding sphere about the centroid
  };
  std::vector<Triangle> triangles_;
};

}  // namespace regrasp::collision
