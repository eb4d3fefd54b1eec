#include "planner/sampling/boundary_draw.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "planner/criteria/clearance.h"
#include "planner/criteria/reach.h"
#include "planner/grasp/edge_contact.h"

namespace regrasp {

namespace {

/// Contacts drawn before room is no longer asked for: on nearly all of a boundary fingers have it.
constexpr int kMostDraws = 1000;

struct Direction {
  double angle;  ///< in (-pi, pi]
  Eigen::Vector3d normal;
};

std::vector<Direction> SortedNormals(const Polygon& polygon) {
  std::vector<Direction> sorted;
  for (int e = 0; e < polygon.face_count(); ++e) {
    const Eigen::Vector3d normal = polygon.inward_normal(e);
    sorted.push_back({std::atan2(normal.y(), normal.x()), normal});
  }
  std::ranges::sort(sorted, {}, &Direction::angle);
  return sorted;
}

/// Of a force-closure grasp of two contacts each lies in the other's cone, and so the two normals
/// are opposed but for less than both half-angles. Of each normal only those beside its opposite in
/// the order of angles are looked at.
bool HasOpposedEdges(const Polygon& polygon, double half_angle) {
  const double least = std::cos(2 * half_angle);
  const std::vector<Direction> sorted = SortedNormals(polygon);
  const std::size_t n = sorted.size();
  return std::ranges::any_of(sorted, [&](const Direction& one) {
    const double opposite = one.angle + (one.angle > 0 ? -std::numbers::pi : std::numbers::pi);
    const auto after = static_cast<std::size_t>(
        std::ranges::lower_bound(sorted, opposite, {}, &Direction::angle) - sorted.begin());
    const auto is_opposed = [&](std::size_t i) {
      return -one.normal.dot(sorted[i % n].normal) > least;
    };
    return is_opposed(after) || is_opposed(after + n - 1);
  });
}

}  // namespace

Grasp DrawOnBoundary(const Polygon& polygon, int contacts, RandomStream& random,
                     double finger_radius) {
  double perimeter = 0;
  for (int e = 0; e < polygon.face_count(); ++e) perimeter += polygon.face_measure(e);
  Grasp grasp;
  for (int draw = 0; static_cast<int>(grasp.size()) < contacts; ++draw) {
    double along = random.Uniform() * perimeter;
    int edge = 0;
    while (edge + 1 < polygon.face_count() && along >= polygon.face_measure(edge)) {
      along -= polygon.face_measure(edge++);
    }
    const Contact contact =
        ContactAt(polygon, edge, std::min(along / polygon.face_measure(edge), 1.0));
    const bool serves = HasClearance(polygon, contact) && CanReach(polygon, contact, finger_radius);
    if (!serves && draw > kMostDraws && finger_radius > 0) break;
    if (serves || draw > kMostDraws) grasp.push_back(contact);
  }
  return grasp;
}

std::optional<Grasp> DrawAnyGrasp(const Polygon& polygon, int least, int most,
                                  const GraspEvaluator& evaluator, RandomStream& random,
                                  const std::function<void()>& before_draw) {
  const int numbers = most - least + 1;
  const int first = static_cast<int>(random.Index(numbers));
  for (int i = 0; i < numbers; ++i) {
    const int contacts = least + (first + i) % numbers;
    if (contacts == 2 && !HasOpposedEdges(polygon, evaluator.half_angle())) continue;
    auto grasp = DrawGoodGrasp(
        [&] {
          before_draw();
          return DrawOnBoundary(polygon, contacts, random, evaluator.finger_radius());
        },
        evaluator.frame(), evaluator.half_angle(), evaluator.min_quality(),
        kSamePoint * polygon.diameter(), evaluator.finger_radius());
    if (grasp) return grasp;
  }
  return std::nullopt;
}

}  // namespace regrasp
