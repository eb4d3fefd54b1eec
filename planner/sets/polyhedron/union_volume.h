#pragma once

#include <Eigen/Core>
#include <cmath>
#include <span>

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
  /// @param part     must outlive this object; a single point has its double-sided cone.
  /// @param tangent  tan φ of the cones.
  UnionVolume(const FacePart& part, bool inner, double tangent)
      : part_(&part),
        cos_(1 / std::sqrt(1 + tangent * tangent)),
        sin_((inner ? 1 : -1) * tangent * cos_) {}

  /// The linear function that touches g at x and is nowhere above it.
  [[nodiscard]] Cut CutAt(const Eigen::Vector3d& x) const;

  /// g(x).
  [[nodiscard]] double At(const Eigen::Vector3d& x) const { return CutAt(x).At(x); }

 private:
  const FacePart* part_;
  double cos_;
  double sin_;  ///< negative on the outer side
};

/// Of the cuts of some volumes at x the one that is largest there; the first of equal ones.
[[nodiscard]] inline Cut LargestCutAt(std::span<const UnionVolume> volumes,
                                      const Eigen::Vector3d& x) {
  Cut largest = volumes.front().CutAt(x);
  double value = largest.At(x);
  for (const UnionVolume& volume : volumes.subspan(1)) {
    const Cut cut = volume.CutAt(x);
    const double at = cut.At(x);
    if (at <= value) continue;
    value = at;
    largest = cut;
  }
  return largest;
}

}  // namespace regrasp::polyhedron
