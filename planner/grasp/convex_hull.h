#pragma once

#include <Eigen/Core>
#include <vector>

namespace regrasp::grasp {

/// Facet of a convex hull. normal · x <= offset for all x of the hull, |normal| = 1.
struct HullFacet {
  Eigen::VectorXd normal;
  double offset;
};

/// Facets of the convex hull of points in any dimension.
/// Computed with Qhull (Barber, Dobkin and Huhdanpaa 1996); its input is joggled so that all facets
/// are simplices.
struct ConvexHull {
  std::vector<HullFacet> facets;
  /// Distance by which the facets' half-spaces must move inwards so that the exact hull contains
  /// their intersection.
  double joggle = 0;
};

/// Compute the convex hull of points.
/// @param points  one point per column, of full dimension.
/// @throws std::runtime_error  if Qhull fails, because the points are not of full dimension.
[[nodiscard]] ConvexHull ComputeConvexHull(const Eigen::MatrixXd& points);

}  // namespace regrasp::grasp
