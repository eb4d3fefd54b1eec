#include "planner/gait/contact_kinds.h"

#include <algorithm>

namespace regrasp::gait {
namespace {

/// From the first contact of a group, metres, and the cosine between their normals.
constexpr double kRadius = 0.02;
constexpr double kLeastCosine = 0.7;

}  // namespace

ContactKinds::ContactKinds(const std::vector<SurfacePoint>& points) {
  std::vector<const SurfacePoint*> firsts;
  for (const SurfacePoint& point : points) {
    const auto found = std::ranges::find_if(firsts, [&](const SurfacePoint* first) {
      return (first->p - point.p).norm() < kRadius && first->n.dot(point.n) > kLeastCosine;
    });
    groups_.push_back(static_cast<int>(found - firsts.begin()));
    if (found == firsts.end()) firsts.push_back(&point);
  }
}

Holding ContactKinds::KindOf(Holding holding) const {
  for (int& point : holding) {
    if (point != kNone) point = groups_[point];
  }
  return holding;
}

}  // namespace regrasp::gait
