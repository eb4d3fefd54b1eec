#pragma once

#include <array>
#include <optional>

#include "planner/sets/polygon/plane.h"

namespace regrasp::polygon {

/// A convex cone of directions, less than π wide: those left of `right` and right of `left`.
template <class NT>
struct DirectionCone {
  Vector2<NT> right;
  Vector2<NT> left;

  friend DirectionCone operator-(const DirectionCone& c) { return {-c.right, -c.left}; }
};

/// The cone about an edge's inward normal.
template <class NT>
DirectionCone<NT> ConeOf(const EdgeFrame<NT>& frame) {
  return {frame.right, frame.left};
}

/// The intersection of two cones; nullopt where they have no common interior.
template <class NT>
std::optional<DirectionCone<NT>> Intersect(const DirectionCone<NT>& a, const DirectionCone<NT>& b) {
  // A border of the intersection is a border of one that lies in the other.
  const auto begins_in = [](const Vector2<NT>& v, const DirectionCone<NT>& cone) {
    return Sign(Cross(cone.right, v)) >= 0 && Sign(Cross(v, cone.left)) > 0;
  };
  const auto ends_in = [](const Vector2<NT>& v, const DirectionCone<NT>& cone) {
    return Sign(Cross(cone.right, v)) > 0 && Sign(Cross(v, cone.left)) >= 0;
  };
  DirectionCone<NT> common;
  if (begins_in(a.right, b)) {
    common.right = a.right;
  } else if (begins_in(b.right, a)) {
    common.right = b.right;
  } else {
    return std::nullopt;
  }
  common.left = ends_in(a.left, b) ? a.left : b.left;
  return common;
}

/// The common cone of parallel grasps: directions in the cones of `b` and `c` and against that of
/// the centre.
template <class NT>
std::optional<DirectionCone<NT>> CommonCone(const EdgeFrame<NT>& centre, const EdgeFrame<NT>& b,
                                            const EdgeFrame<NT>& c) {
  const auto outer = Intersect(ConeOf(b), ConeOf(c));
  return outer ? Intersect(*outer, -ConeOf(centre)) : std::nullopt;
}

}  // namespace regrasp::polygon
