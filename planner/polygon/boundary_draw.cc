#include "planner/polygon/boundary_draw.h"

#include <algorithm>
#include <cmath>

#include "planner/plan/clearance.h"
#include "planner/plan/reach.h"
#include "planner/polygon/set_cells.h"

namespace regrasp {

namespace {

/// Contacts drawn before room is no longer asked for: on nearly all of a boundary fingers have it.
constexpr int kMostDraws = 1000;

/// Of a force-closure grasp of two contacts each lies in the other's cone, and so the two normals
/// are opposed but for less than both half-angles.
bool HasOpposedEdges(const Polygon& polygon, double half_angle) {
  const double least = std::cos(2 * half_angle);
  for (int a = 0; a < polygon.face_count(); ++a) {
    for (int b = 0; b < a; ++b) {
      if (-polygon.inward_normal(a).dot(polygon.inward_normal(b)) > least) return true;
    }
  }
  return false;
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
    const bool serves =
        HasStandingRoom(polygon, contact) && CanReach(polygon, contact, finger_radius);
    if (!serves && draw > kMostDraws && finger_radius > 0) break;
    if (serves || draw > kMostDraws) grasp.push_back(contact);
  }
  return grasp;
}

std::optional<Grasp> DrawAnyGrasp(const Polygon& polygon, int least, int most,
                                  const GraspJudge& judge, RandomStream& random) {
  const int numbers = most - least + 1;
  const int first = static_cast<int>(random.Index(numbers));
  for (int i = 0; i < numbers; ++i) {
    const int contacts = least + (first + i) % numbers;
    if (contacts == 2 && !HasOpposedEdges(polygon, judge.half_angle())) continue;
    auto grasp = DrawGoodGrasp(
        [&] { return DrawOnBoundary(polygon, contacts, random, judge.finger_radius()); },
        judge.frame(), judge.half_angle(), judge.min_quality(), kSamePoint * polygon.diameter(),
        judge.finger_radius());
    if (grasp) return grasp;
  }
  return std::nullopt;
}

}  // namespace regrasp
