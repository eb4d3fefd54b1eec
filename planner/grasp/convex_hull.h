#pragma once

#include <Eigen/Core>
#include <vector>

namespace regrasp::grasp {

/// A facet of a convex hull: normal · x <= offset holds for all of it, |normal| = 1.
struct HullFacet {
  Eigen::VectorXd normal;
  double offset;
};

/// The facets of the convex hull of points in any dimension (Qhull, Barber, Dobkin and Huhdanpaa
/// 1996, input joggled so that all facets are simplices).
struct ConvexHull {
  std::vector<HullFacet> facets;
  /// The exact hull contains the intersection of the facets' half-spaces moved inwards by this.
  double joggle = 0;
};

/// @param points  one per column, of full dimension.
/// @throws std::runtime_error  Qhull gives up (points that are not of full dimension).
[[nodiscard]] ConvexHull ComputeConvexHull(const Eigen::MatrixXd& points);

}  // namespace regrasp::grasp
