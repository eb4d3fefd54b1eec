#include "planner/object/surface_walk.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace regrasp::object {

using Eigen::Vector3d;

namespace {

/// Extension of borders beyond their ends, divided by their length, so that no path passes through
/// a vertex.
constexpr double kBeyondEnds = 1e-9;

/// Point at which a straight path on a face crosses a border.
struct Crossing {
  double share = 0;  ///< fraction of the path before it, in [0, 1]
  Vector3d point;
  FaceIndex beyond;
  Vector3d onward;  ///< remaining displacement on the next face
};

/// Return the direction of a polygon's edge, with the material on the left.
Vector3d AlongEdge(const Vector3d& inward_normal) {
  return {inward_normal.y(), -inward_normal.x(), 0};
}

std::optional<Crossing> FirstVertex(const Object& object, FaceIndex face, const Vector3d& point,
                                    const Vector3d& way) {
  const double ahead = way.dot(AlongEdge(object.inward_normal(face)));
  const FaceBorder& border = object.BordersOf(face)[ahead > 0 ? 1 : 0];
  const double share = way.norm() > 0 ? (border.a - point).norm() / way.norm() : 1;
  if (share >= 1) return std::nullopt;
  return Crossing{share, border.a, border.beyond,
                  (1 - share) * ahead * AlongEdge(object.inward_normal(border.beyond))};
}

std::optional<Crossing> FirstSide(const Object& object, FaceIndex face, const Vector3d& point,
                                  const Vector3d& way) {
  const Vector3d& n = object.inward_normal(face);
  std::optional<Crossing> first;
  for (const FaceBorder& border : object.BordersOf(face)) {
    const Vector3d side = border.b - border.a;
    const double length = side.norm();
    if (!(length > 0)) continue;
    const Vector3d along = side / length;
    const Vector3d outwards = n.cross(along);
    const double leaving = way.dot(outwards);
    if (!(leaving > 0)) continue;
    const double share = std::max((border.a - point).dot(outwards) / leaving, 0.0);
    if (share >= (first ? first->share : 1)) continue;
    const double at = (point + share * way - border.a).dot(along) / length;
    if (at < -kBeyondEnds || at > 1 + kBeyondEnds) continue;
    const Vector3d into = object.inward_normal(border.beyond).cross(along);
    first = Crossing{share, border.a + std::clamp(at, 0.0, 1.0) * side, border.beyond,
                     (1 - share) * (way.dot(along) * along + leaving * into)};
  }
  return first;
}

std::optional<Crossing> FirstCrossing(const Object& object, FaceIndex face, const Vector3d& point,
                                      const Vector3d& way) {
  return object.dimension() == 2 ? FirstVertex(object, face, point, way)
                                 : FirstSide(object, face, point, way);
}

/// Find the border point of the shortest path to a goal on a neighbouring face, across their common
/// border; nullopt if no such path is straight on both faces.
std::optional<Vector3d> CrossTo(const Object& object, FaceIndex face, const Vector3d& point,
                                FaceIndex goal_face, const Vector3d& goal) {
  const double tolerance = kPointTolerance * object.diameter();
  std::optional<Vector3d> best;
  double least = 0;
  for (const FaceBorder& border : object.BordersOf(face)) {
    if (border.beyond != goal_face) continue;
    const Vector3d side = border.b - border.a;
    const double length = side.norm();
    if (!(length > 0)) continue;
    const Vector3d along = side / length;
    // Coordinates in the unfolded plane of both faces: along the border, and distance from it.
    const double from = (point - border.a).dot(along), to = (goal - border.a).dot(along);
    const double before = (point - border.a).cross(along).norm();
    const double beyond = (goal - border.a).cross(along).norm();
    const double share = before + beyond > 0 ? before / (before + beyond) : 0;
    const Vector3d at = border.a + std::clamp(from + share * (to - from), 0.0, length) * along;
    const double way = (at - point).norm() + (goal - at).norm();
    if ((best && way >= least) || !object.ContainsSegment(face, point, at, tolerance) ||
        !object.ContainsSegment(goal_face, at, goal, tolerance))
      continue;
    best = at;
    least = way;
  }
  return best;
}

/// Find the shorter path along a polygon's boundary.
std::optional<std::vector<SurfaceLeg>> GoAround(const Object& object, FaceIndex face,
                                                const Vector3d& point, FaceIndex goal_face,
                                                const Vector3d& goal) {
  std::optional<std::vector<SurfaceLeg>> shorter;
  double least = 0;
  for (const int end : {0, 1}) {
    std::vector<SurfaceLeg> legs;
    SurfaceLeg leg{face, point, point};
    double length = 0;
    while (leg.face != goal_face && legs.size() < kMostLegs) {
      const FaceBorder& border = object.BordersOf(leg.face)[end];
      leg.to = border.a;
      length += (leg.to - leg.from).norm();
      legs.push_back(leg);
      leg = {border.beyond, border.a, border.a};
    }
    if (leg.face != goal_face) continue;
    leg.to = goal;
    length += (leg.to - leg.from).norm();
    legs.push_back(leg);
    if (shorter && length >= least) continue;
    shorter = std::move(legs);
    least = length;
  }
  return shorter;
}

bool IsOn(const Object& object, FaceIndex face, const Vector3d& point) {
  return (object.ClosestPoint(face, point) - point).norm() <= kPointTolerance * object.diameter();
}

}  // namespace

std::optional<std::vector<SurfaceLeg>> WalkStraight(const Object& object, FaceIndex face,
                                                    const Vector3d& point,
                                                    const Vector3d& displacement) {
  std::vector<SurfaceLeg> legs;
  SurfaceLeg leg{face, point, point};
  Vector3d left = displacement;
  while (legs.size() < kMostLegs) {
    const auto crossing = FirstCrossing(object, leg.face, leg.from, left);
    leg.to = crossing ? crossing->point : Vector3d(leg.from + left);
    if (!IsOn(object, leg.face, leg.to)) return std::nullopt;
    legs.push_back(leg);
    if (!crossing) return legs;
    leg = {crossing->beyond, crossing->point, crossing->point};
    left = crossing->onward;
  }
  return std::nullopt;
}

std::optional<std::vector<SurfaceLeg>> HeadFor(const Object& object, FaceIndex face,
                                               const Vector3d& point, FaceIndex goal_face,
                                               const Vector3d& goal) {
  if (object.dimension() == 2) return GoAround(object, face, point, goal_face, goal);
  const double tolerance = kPointTolerance * object.diameter();
  std::vector<SurfaceLeg> legs;
  SurfaceLeg leg{face, point, point};
  while (legs.size() < kMostLegs) {
    if (leg.face == goal_face && object.ContainsSegment(leg.face, leg.from, goal, tolerance)) {
      leg.to = goal;
      legs.push_back(leg);
      return legs;
    }
    if (const auto border = CrossTo(object, leg.face, leg.from, goal_face, goal)) {
      leg.to = *border;
      legs.push_back(leg);
      legs.push_back({goal_face, *border, goal});
      return legs;
    }
    const Vector3d& n = object.inward_normal(leg.face);
    const Vector3d there = goal - leg.from;
    const Vector3d ahead = there - n * n.dot(there);
    if (!(ahead.norm() > 0)) return std::nullopt;
    // Continue to the border even if the goal's projection is inside this face.
    const Vector3d way = ahead * (2 * object.diameter() / ahead.norm());
    const auto crossing = FirstCrossing(object, leg.face, leg.from, way);
    if (!crossing || !IsOn(object, leg.face, crossing->point)) return std::nullopt;
    leg.to = crossing->point;
    legs.push_back(leg);
    leg = {crossing->beyond, crossing->point, crossing->point};
  }
  return std::nullopt;
}

}  // namespace regrasp::object
