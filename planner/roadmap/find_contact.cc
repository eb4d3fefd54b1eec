#include "planner/roadmap/find_contact.h"

#include <algorithm>

namespace regrasp::roadmap {

std::optional<int> FindContact(const std::vector<grasp::Contact>& points,
                               const grasp::Contact& contact, double tolerance) {
  const auto found = std::find_if(points.begin(), points.end(), [&](const grasp::Contact& point) {
    return point.face == contact.face && (point.p - contact.p).norm() <= tolerance;
  });
  if (found == points.end()) return std::nullopt;
  return static_cast<int>(found - points.begin());
}

}  // namespace regrasp::roadmap
