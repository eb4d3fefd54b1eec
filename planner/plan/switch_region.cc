#include "planner/plan/switch_region.h"

#include <algorithm>

#include "planner/plan/contact_region.h"

namespace regrasp::plan {

namespace {

std::optional<double> SmallestClaim(const FingerGrasp& placed) {
  std::optional<double> claimed;
  for (const FingerContact& held : placed) {
    if (held.region) claimed = std::min(claimed.value_or(*held.region), *held.region);
  }
  return claimed;
}

}  // namespace

std::optional<SwitchRegion> MeasureSwitchRegion(const object::Polygon& polygon,
                                                const FingerGrasp& before, const Switch& step,
                                                double half_angle) {
  const FingerGrasp after = GraspAfter(before, step);
  if (before.size() != 2 || after.size() != 2) return std::nullopt;
  const double limit = polygon.diameter();
  SwitchRegion region;
  // The second search need not go beyond what the first one found.
  region.half_width =
      MeasureContactRegion(polygon, ContactsOf(after), half_angle,
                           MeasureContactRegion(polygon, ContactsOf(before), half_angle, limit));
  region.claimed = SmallestClaim(step.place);
  region.holds = !region.claimed || *region.claimed <= region.half_width + object::kPointTolerance *
                                                                               polygon.diameter();
  return region;
}

}  // namespace regrasp::plan
