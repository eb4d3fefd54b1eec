#include "planner/tree/surface_route.h"

#include <algorithm>
#include <queue>
#include <set>

#include "planner/criteria/reach.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/motion/check_motion_proof.h"

namespace regrasp::tree {

using Eigen::Vector3d;

namespace {

/// Number of rounds that move the points of a route towards the shortest path; routes have few
/// crossings, so few rounds suffice.
constexpr int kPullRounds = 8;

/// Distance over the diameter at which a point counts as on an edge: the rounding of the border.
constexpr double kOnEdge = 1e-10;

/// Return the point of an edge on the shortest path from p to q, which are on its two sides.
Vector3d CrossingPoint(const object::FaceBorder& edge, const Vector3d& p, const Vector3d& q) {
  const double length = (edge.b - edge.a).norm();
  if (!(length > 0)) return edge.a;
  const Vector3d along = (edge.b - edge.a) / length;
  const double p_along = (p - edge.a).dot(along);
  const double q_along = (q - edge.a).dot(along);
  const double p_off = (p - edge.a - p_along * along).norm();
  const double q_off = (q - edge.a - q_along * along).norm();
  const double share = p_off + q_off > 0 ? p_off / (p_off + q_off) : 0.5;
  const double at = p_along + share * (q_along - p_along);
  return edge.a + std::clamp(at, kFromCorner * length, (1 - kFromCorner) * length) * along;
}

/// Reached face, and the point at which it was entered.
struct Entry {
  FaceIndex face;
  Vector3d at;
  double length;  ///< length of the path to that point
  int crossings;
  int parent;               ///< index of the previous entry; −1 for the first face
  object::FaceBorder edge;  ///< crossed edge of the parent
};

class RouteSearch {
 public:
  RouteSearch(const object::Object& object, const grasp::Contact& from, const grasp::Contact& to,
              const RouteLimits& limits)
      : object_(object), from_(from), to_(to), limits_(limits) {}

  std::optional<SurfaceRoute> Find() {
    const int last = FindLast();
    if (last < 0) return std::nullopt;
    SurfaceRoute route = MakeRoute(last);
    return IsValid(route) ? std::optional(std::move(route)) : std::nullopt;
  }

 private:
  /// Return the entry of the last face; −1 if it was not reached.
  int FindLast() {
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>>
        queue;
    const auto push = [&](const Entry& entry) {
      queue.emplace(entry.length + (to_.p - entry.at).norm(), static_cast<int>(entries_.size()));
      entries_.push_back(entry);
    };
    std::set<FaceIndex> done;
    push({from_.face, from_.p, 0, 0, -1, {}});
    while (!queue.empty()) {
      const int number = queue.top().second;
      queue.pop();
      const Entry entry = entries_[number];
      if (entry.face == to_.face) return number;
      if (entry.crossings == limits_.crossings || !done.insert(entry.face).second) continue;
      for (const object::FaceBorder& edge : object_.BordersOf(entry.face)) {
        if (!CanCross(entry.face, edge) || done.contains(edge.beyond)) continue;
        const Vector3d at = CrossingPoint(edge, entry.at, to_.p);
        push({edge.beyond, at, entry.length + (at - entry.at).norm(), entry.crossings + 1, number,
              edge});
      }
    }
    return -1;
  }

  [[nodiscard]] bool CanCross(FaceIndex face, const object::FaceBorder& edge) const {
    return grasp::AngleBetween(object_.inward_normal(face), object_.inward_normal(edge.beyond)) <=
           (edge.convex ? motion::kMostTurn : limits_.concave);
  }

  SurfaceRoute MakeRoute(int last) const {
    std::vector<const Entry*> crossings;
    for (int i = last; entries_[i].parent >= 0; i = entries_[i].parent) {
      crossings.push_back(&entries_[i]);
    }
    std::reverse(crossings.begin(), crossings.end());
    std::vector<Vector3d> points = {from_.p};
    for (const Entry* crossing : crossings) points.push_back(crossing->at);
    points.push_back(to_.p);
    const double on_edge = kOnEdge * object_.diameter();
    for (int round = 0; round < kPullRounds; ++round) {
      for (std::size_t i = 0; i < crossings.size(); ++i) {
        Vector3d& point = points[i + 1];
        point = CrossingPoint(crossings[i]->edge, points[i], points[i + 2]);
        for (const Vector3d& end : {from_.p, to_.p}) {
          if ((point - end).norm() <= on_edge) point = end;
        }
      }
    }
    SurfaceRoute route = {from_};
    for (std::size_t i = 0; i < crossings.size(); ++i) {
      const FaceIndex beyond = crossings[i]->face;
      const double torsion = route.back().torsion;
      route.push_back({points[i + 1], route.back().n, route.back().face, torsion});
      route.push_back({points[i + 1], object_.inward_normal(beyond), beyond, torsion});
    }
    route.push_back(to_);
    return route;
  }

  [[nodiscard]] bool IsValid(const SurfaceRoute& route) const {
    const double tolerance = object::kPointTolerance * object_.diameter();
    for (std::size_t i = 0; i < route.size(); i += 2) {
      if (!object_.ContainsSegment(route[i].face, route[i].p, route[i + 1].p, tolerance)) {
        return false;
      }
    }
    return limits_.concave > 0 ||
           std::all_of(route.begin() + 1, route.end() - 1, [&](const grasp::Contact& edge) {
             return criteria::HasClearance(object_, edge);
           });
  }

  const object::Object& object_;
  const grasp::Contact& from_;
  const grasp::Contact& to_;
  const RouteLimits& limits_;
  std::vector<Entry> entries_;
};

}  // namespace

std::optional<SurfaceRoute> FindSurfaceRoute(const object::Object& object,
                                             const grasp::Contact& from, const grasp::Contact& to,
                                             const RouteLimits& limits) {
  return RouteSearch(object, from, to, limits).Find();
}

double LengthOf(const SurfaceRoute& route) {
  double length = 0;
  for (std::size_t i = 1; i < route.size(); ++i) length += (route[i].p - route[i - 1].p).norm();
  return length;
}

}  // namespace regrasp::tree
