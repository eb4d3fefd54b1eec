#pragma once

#include <Eigen/Core>
#include <cmath>
#include <span>

#include "planner/sets/polyhedron/face_part.h"

namespace regrasp::polyhedron {

/// Linear function gradient · x + offset.
struct Cut {
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double offset = 0;

  [[nodiscard]] double At(const Eigen::Vector3d& x) const { return gradient.dot(x) + offset; }
};

/// Half of the union volume of a convex part of a face (Phoka 2010, definition 5.4).
///
/// It contains the points that see a contact of the part inside its friction cone. They are on the
/// inner side of the face, to which the contact's force points, or on the outer side. With h the
/// height of x over the face's plane on that side and d the distance of its foot from the part, x
/// is inside iff
///
///     g(x) = cos φ · d(x) − sin φ · h(x) < 0.
///
/// g is convex with slopes of at most 1. If g(x) is negative, −g(x) is the distance of x from the
/// border of the cone about the part's point nearest to its foot.
class UnionVolume {
 public:
  /// @param part     must outlive this object. For a single point, the two halves are its
  ///     double-sided cone.
  /// @param tangent  tan φ of the cones.
  UnionVolume(const FacePart& part, bool inner, double tangent)
      : part_(&part),
        cos_(1 / std::sqrt(1 + tangent * tangent)),
        sin_((inner ? 1 : -1) * tangent * cos_) {}

  /// Return the linear function that equals g at x and is at most g everywhere.
  [[nodiscard]] Cut CutAt(const Eigen::Vector3d& x) const;

  /// Return g(x).
  [[nodiscard]] double At(const Eigen::Vector3d& x) const { return CutAt(x).At(x); }

 private:
  const FacePart* part_;
  double cos_;
  double sin_;  ///< negative on the outer side
};

/// Return the cut at x that is largest there among those of some volumes; the first of equal ones.
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
