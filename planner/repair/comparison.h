#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/object/polygon_soup.h"

namespace regrasp::repair {

/// Distances from the points of one surface to another surface, in object units.
/// The sampled points are spread evenly over the area.
struct DistanceSummary {
  double mean = 0;
  double most = 0;     ///< 95th percentile
  double largest = 0;  ///< maximum over the sampled points
  double bound = 0;    ///< upper bound of the distance of all points, up to rounding
  Eigen::Vector3d where = Eigen::Vector3d::Zero();  ///< farthest sampled point
};

/// Difference between a solid and the surface that it was made from.
struct Comparison {
  DistanceSummary to_solid;     ///< distances from the whole original
  double seen_share = 0;        ///< share of the original's area that is visible from outside
  double seen_most = 0;         ///< 95th percentile of the visible points' distances
  DistanceSummary to_original;  ///< distances from the solid
  /// Mean angle in radians between a visible triangle and the solid's nearest triangle.
  double normal_mean = 0;
  double normal_most = 0;  ///< 95th percentile of these angles
  /// Marks of the solid's filled triangles.
  /// A triangle is filled if some point of it is farther than kFilledDistance from the original.
  std::vector<bool> filled;
  double filled_share = 0;  ///< share of the solid's area
  double thin_share = 0;    ///< share of the solid's area with a wall thinner than kThinWall
};

/// Distance from the original, over the diameter, beyond which a triangle is filled surface.
/// A fingertip does not feel a filled gap that deviates by less.
inline constexpr double kFilledDistance = 0.005;

/// Wall thickness over the diameter below which a wall is a sheet wrapped on both sides.
inline constexpr double kThinWall = 0.004;

/// Compare a surface with the solid made from it.
/// The result is deterministic because sampled points are spread without random numbers. A point is
/// visible from outside if at least 3 of 64 rays from it, spread evenly over all directions, hit
/// nothing.
/// @param original, solid  surfaces of triangles.
[[nodiscard]] Comparison Compare(const object::PolygonSoup& original,
                                 const object::PolygonSoup& solid, double diameter);

/// Return the triangles of an original from which one part of its solids was made.
/// These are the triangles whose centroid is not nearer to another part.
/// @param all  all parts, `part` included.
[[nodiscard]] object::PolygonSoup OriginalOfPart(const object::PolygonSoup& original,
                                                 const object::PolygonSoup& all,
                                                 const object::PolygonSoup& part);

/// Mark the filled surface of a solid.
/// Marked triangles are those that the comparison marks, and those at which the original itself has
/// marks of an earlier repair.
/// @param original  surface of the file, with its marks.
/// @param comparison  comparison of the two surfaces; a default Comparison marks nothing.
void MarkFilled(const object::PolygonSoup& original, const Comparison& comparison,
                object::PolygonSoup& solid);

/// Return the share of the area that is marked as filled.
[[nodiscard]] double FilledShare(const object::PolygonSoup& solid);

/// Move marked triangles behind all others, as required by the file format of a solid.
void FilledLast(object::PolygonSoup& solid);

}  // namespace regrasp::repair
