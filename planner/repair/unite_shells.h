#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <Eigen/Core>

namespace regrasp::repair {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPoint = ExactKernel::Point_3;

/// Round an exact point to doubles, such that equal points give equal bits. For .cc files only.
/// CGAL::to_double of a lazily evaluated coordinate depends on earlier evaluations.
[[nodiscard]] inline Eigen::Vector3d Rounded(const ExactPoint& point) {
  const auto& exact = CGAL::exact(point);
  return {CGAL::to_double(exact.x()), CGAL::to_double(exact.y()), CGAL::to_double(exact.z())};
}

}  // namespace regrasp::repair
