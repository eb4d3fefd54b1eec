#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/object/polygon_soup.h"

namespace regrasp::repair {

/// Distances of one surface's points to another surface, evenly over its area; in the object's unit
/// of length.
struct DistanceSummary {
  double mean = 0;
  double most = 0;     ///< 95 % of the area is no farther
  double largest = 0;  ///< of the points looked at
  double bound = 0;    ///< no point is farther than this, up to rounding
  Eigen::Vector3d where = Eigen::Vector3d::Zero();  ///< the point that is farthest
};

/// How a solid differs from the surface that it was made from.
struct Comparison {
  DistanceSummary to_solid;     ///< of all of the original
  double seen_share = 0;        ///< of the original's area that is seen from outside
  double seen_most = 0;         ///< as DistanceSummary::most, of what is seen
  DistanceSummary to_original;  ///< of the solid
  double normal_mean = 0;  ///< radians between a facet seen from outside and the solid's nearest
  double normal_most = 0;  ///< 95 % of what is seen have turned by no more
  /// The solid's facets that are no part of the original: some point is farther than
  /// kInventedDistance from it.
  std::vector<bool> invented;
  double invented_share = 0;  ///< of the solid's area
  double thin_share = 0;      ///< of the solid's area, where it is thinner than kThinWall
};

/// A facet of a repaired solid with a point farther than this, over the diameter, from the original
/// surface was invented: a gap that is filled by less is smaller than what a fingertip feels.
inline constexpr double kInventedDistance = 0.005;

/// A wall thinner than this over the diameter is the two sides of a wrapped sheet.
inline constexpr double kThinWall = 0.004;

/// The same surfaces give the same numbers: points are spread without chance. A point is seen from
/// outside where 3 of 64 rays from it, evenly in all directions, meet nothing.
/// @param original, solid  facets of three corners.
[[nodiscard]] Comparison Compare(const object::PolygonSoup& original,
                                 const object::PolygonSoup& solid, double diameter);

/// Of an original what a part of its solids was made from: the facets whose centre is no nearer to
/// another part.
/// @param all  the part and all others.
[[nodiscard]] object::PolygonSoup OriginalOfPart(const object::PolygonSoup& original,
                                                 const object::PolygonSoup& all,
                                                 const object::PolygonSoup& part);

}  // namespace regrasp::repair
