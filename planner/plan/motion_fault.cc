#include "planner/plan/motion_fault.h"

#include <algorithm>
#include <numbers>

#include "planner/grasp/angle_between.h"
#include "planner/plan/tolerance.h"

namespace regrasp::plan {

namespace {

/// Whether a contact can turn from a face to another at a point of both: it reaches that point, and
/// leaves it, without leaving the faces.
bool TurnsAtCommonPoint(const object::Object& object, const grasp::Contact& from,
                        const grasp::Contact& to, double tolerance) {
  // Each of two points that should be one may be off by the tolerance.
  const auto common = object.CommonPoints(from.face, to.face, from.p, 2 * tolerance);
  return std::ranges::any_of(common, [&](const Eigen::Vector3d& p) {
    return object.ContainsSegment(from.face, from.p, p, tolerance) &&
           object.ContainsSegment(to.face, p, to.p, tolerance);
  });
}

}  // namespace

std::optional<std::string> FindMotionFault(const object::Object& object, const grasp::Contact& from,
                                           const grasp::Contact& to) {
  const double tolerance = object::kPointTolerance * object.diameter();
  if (from.face == to.face) {
    if (object.ContainsSegment(from.face, from.p, to.p, tolerance)) return std::nullopt;
    return "leaves face " + std::to_string(from.face);
  }
  const std::string faces =
      "from face " + std::to_string(from.face) + " to face " + std::to_string(to.face);
  if (!((from.p - to.p).norm() <= tolerance)) {
    return "moves " + faces + " without turning at a point that both contain";
  }
  if (!TurnsAtCommonPoint(object, from, to, tolerance)) {
    return "turns " + faces + ", which do not meet there";
  }
  if (grasp::AngleBetween(from.n, to.n) > std::numbers::pi - kNormalTolerance) {
    return "turns " + faces + ", whose normals are opposite";
  }
  return std::nullopt;
}

}  // namespace regrasp::plan
