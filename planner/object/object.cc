#include "planner/object/object.h"

#include <algorithm>

#include "planner/object/segment.h"

namespace regrasp::object {

using Eigen::Vector3d;

bool Object::AreNeighbours(FaceIndex face, FaceIndex other) const {
  return std::ranges::any_of(BordersOf(face),
                             [&](const FaceBorder& border) { return border.beyond == other; });
}

std::vector<Vector3d> Object::CommonPoints(FaceIndex face, FaceIndex other, const Vector3d& point,
                                           double tolerance) const {
  std::vector<Vector3d> points;
  const auto is_near = [&](const Vector3d& p) { return (p - point).norm() <= tolerance; };
  const auto add = [&](const Vector3d& p) {
    if (is_near(p)) points.push_back(p);
  };
  std::vector<Vector3d> corners;
  for (const FaceBorder& border : BordersOf(face)) {
    if (border.beyond == other) add(ClosestOnSegment(border.a, border.b, point));
    // Every corner of a border is the start of one of its segments.
    if (is_near(border.a)) corners.push_back(border.a);
  }
  if (corners.empty()) return points;
  for (const FaceBorder& border : BordersOf(other)) {
    if (std::find(corners.begin(), corners.end(), border.a) != corners.end()) add(border.a);
  }
  return points;
}

}  // namespace regrasp::object
