#include "planner/sets/polygon/focus_cell.h"

#include <algorithm>
#include <stdexcept>

#include "planner/sets/polygon/concurrent.h"

namespace regrasp::polygon {

namespace {

/// Cuts a region to the square of half-side `reach` about a point.
void ClipToSquare(const Eigen::Vector2d& centre, double reach, ConvexRegion<Exact>& region) {
  const Exact x(centre.x());
  const Exact y(centre.y());
  const Exact one(1);
  const Exact zero(0);
  const Exact r(reach);
  region.Clip({one, zero, r - x});
  region.Clip({-one, zero, r + x});
  region.Clip({zero, one, r - y});
  region.Clip({zero, -one, r + y});
}

double Quotient(const Exact& numerator, const Exact& denominator) {
  const Interval quotient =
      Interval(CGAL::to_interval(numerator)) / Interval(CGAL::to_interval(denominator));
  return (quotient.inf() + quotient.sup()) / 2;
}

}  // namespace

std::vector<std::vector<Eigen::Vector2d>> FocusCell(const object::Polygon& polygon,
                                                    const GraspSet& set) {
  if (set.type != GraspType::kConcurrent || set.edges.size() != 3) {
    throw std::invalid_argument("a focus cell needs a concurrent set");
  }
  const Eigen::Vector2d centre = polygon.mass_properties().centroid.head<2>();
  const double reach = kFarthestFocus * polygon.diameter();
  const IntervalScope scope;
  const EdgeTable edges(polygon, set.tangent);
  const ConcurrentCandidate candidate = {{set.edges[0], set.edges[1], set.edges[2]}, set.tangent};
  std::vector<std::vector<Eigen::Vector2d>> parts;
  for (const FocusComponent& component : ConcurrentCellFinder(edges).Find(candidate)) {
    for (const FocusPart& part : component.parts) {
      if (std::find(set.parts.begin(), set.parts.end(), part.sides) == set.parts.end()) continue;
      ConvexRegion<Exact> region = part.region.exact();
      {
        const ExactScope exact;
        ClipToSquare(centre, reach, region);
      }
      std::vector<Eigen::Vector2d> corners;
      for (const auto& side : region.sides()) {
        corners.emplace_back(Quotient(side.from.x, side.from.w),
                             Quotient(side.from.y, side.from.w));
      }
      parts.push_back(std::move(corners));
    }
  }
  return parts;
}

}  // namespace regrasp::polygon
