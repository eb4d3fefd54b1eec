#include "sim/world/cone_margin.h"

#include <algorithm>
#include <cmath>

namespace regrasp::sim {

double ConeMargin(const Eigen::Vector3d& force, const Eigen::Vector3d& normal, double half_angle,
                  double twist) {
  return half_angle -
         std::atan2(std::sqrt(TangentialSquare(force, normal, twist)), normal.dot(force));
}

void AddMargin(FingerIndex finger, double margin, FingerMargins& margins) {
  const auto [place, is_new] = margins.try_emplace(finger, margin);
  if (!is_new) place->second = std::min(place->second, margin);
}

std::optional<double> SmallestMargin(const FingerMargins& margins) {
  const FingerIndex finger = FingerOfSmallestMargin(margins);
  return finger.valid() ? std::optional(margins.at(finger)) : std::nullopt;
}

FingerIndex FingerOfSmallestMargin(const FingerMargins& margins) {
  const auto least =
      std::ranges::min_element(margins, {}, [](const auto& entry) { return entry.second; });
  return least == margins.end() ? FingerIndex() : least->first;
}

}  // namespace regrasp::sim
