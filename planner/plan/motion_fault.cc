#include "planner/plan/motion_fault.h"

#include <numbers>

#include "planner/grasp/angle_between.h"
#include "planner/plan/tolerance.h"

namespace regrasp {

std::optional<std::string> FindMotionFault(const Object& object, const Contact& from,
                                           const Contact& to) {
  const double tolerance = kPointTolerance * object.diameter();
  if (from.face == to.face) {
    if (object.ContainsSegment(from.face, from.p, to.p, tolerance)) return std::nullopt;
    return "leaves face " + std::to_string(from.face);
  }
  const std::string faces =
      "from face " + std::to_string(from.face) + " to face " + std::to_string(to.face);
  if (!((from.p - to.p).norm() <= tolerance)) {
    return "moves " + faces + " without turning at a point that both contain";
  }
  if (AngleBetween(from.n, to.n) > std::numbers::pi - kNormalTolerance) {
    return "turns " + faces + ", whose normals are opposite";
  }
  return std::nullopt;
}

}  // namespace regrasp
