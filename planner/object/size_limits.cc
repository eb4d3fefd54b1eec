#include "planner/object/size_limits.h"

#include <algorithm>

#include "planner/base/number.h"

namespace regrasp::object {

std::string SizeComplaint(const std::vector<Eigen::Vector3d>& vertices, double diameter) {
  if (!(diameter >= kMinDiameter)) {
    return "all vertices lie within " + FormatDouble(kMinDiameter) + " of each other";
  }
  const auto too_far = [&](const Eigen::Vector3d& v) { return v.norm() > kMaxOffset * diameter; };
  const auto found = std::ranges::find_if(vertices, too_far);
  if (found == vertices.end()) return "";
  return "too far from the origin (" + FormatShort(found->norm()) + ") for an object of diameter " +
         FormatShort(diameter);
}

std::string EdgeComplaint(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double diameter) {
  const double length = (to - from).stableNorm();
  if (length >= kMinEdge * diameter) return "";
  return "shorter (" + FormatShort(length) + ") than " + FormatDouble(kMinEdge) +
         " of the diameter (" + FormatShort(diameter) + "); make its ends one point";
}

}  // namespace regrasp::object
