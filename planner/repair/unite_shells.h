#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <Eigen/Core>

namespace regrasp::repair {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPoint = ExactKernel::Point_3;

/// A point in doubles; only for .cc files. Equal points give the same bits: what CGAL::to_double
/// says of a coordinate that is evaluated when it is needed depends on what it was needed for.
[[nodiscard]] inline Eigen::Vector3d Rounded(const ExactPoint& point) {
  const auto& exact = CGAL::exact(point);
  return {CGAL::to_double(exact.x()), CGAL::to_double(exact.y()), CGAL::to_double(exact.z())};
}

}  // namespace regrasp::repair
