#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "planner/sets/polyhedron/face_part.h"

namespace regrasp::polyhedron {

/// A linear function gradient · x + offset.
struct Cut {
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double offset = 0;

  [[nodiscard]] double At(const Eigen::Vector3d& x) const { return gradient.dot(x) + offset; }
};

/// One half of the union volume of a convex part of a face (Phoka 2010, definition 5.4): the points
/// that see a contact of the part inside its friction cone, from the inner side of the face, where
/// the contact's force points to, or from the outer side.
///
/// With h the height of x over the face's plane on that side and d the distance of its foot from
/// the part, x is inside iff
///
///     g(x) = cos φ · d(x) − sin φ · h(x) < 0.
///
/// g is convex, its slopes are at most 1, and where it is negative −g is the distance of x from the
/// border of the cone about the foot that is nearest to it.
class UnionVolume {
 public:
  /// What does not depend on the cones: the sides of a part, ready to measure distances.
  struct Shape {
    explicit Shape(const FacePart& part);
    /// A single contact on the part's plane: its double-sided cone.
    Shape(const FacePart& part, const Eigen::Vector3d& contact);

    struct Side {
      Eigen::Vector2d from;
      Eigen::Vector2d along;    ///< unit
      Eigen::Vector2d outward;  ///< unit
      double length;
    };
    Eigen::Vector3d origin;
    Eigen::Vector3d u;
    Eigen::Vector3d v;
    Eigen::Vector3d normal;
    std::vector<Side> sides;  ///< none of a contact, which is at the origin
  };

  /// @param shape    must outlive this object.
  /// @param tangent  tan φ of the cones.
  UnionVolume(const Shape& shape, bool inner, double tangent)
      : shape_(&shape),
        cos_(1 / std::sqrt(1 + tangent * tangent)),
        sin_((inner ? 1 : -1) * tangent * cos_) {}

  /// The linear function that touches g at x and is nowhere above it.
  [[nodiscard]] Cut CutAt(const Eigen::Vector3d& x) const;

  /// g(x).
  [[nodiscard]] double At(const Eigen::Vector3d& x) const { return CutAt(x).At(x); }

 private:
  const Shape* shape_;
  double cos_;
  double sin_;  ///< negative on the outer side
};

}  // namespace regrasp::polyhedron
