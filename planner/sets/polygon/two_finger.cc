#include "planner/sets/polygon/two_finger.h"

namespace regrasp::polygon {

std::vector<TwoFingerPart> FindTwoFingerSets(const EdgeTable& edges,
                                             const TwoFingerCandidate& candidate) {
  std::vector<TwoFingerPart> parts;
  for (const bool stretching : {false, true}) {
    auto region = FilteredRegion::Make([&edges, candidate, stretching](auto zero) {
      using NT = decltype(zero);
      return MakeTwoFingerRegion(edges.frame<NT>(candidate[0]), edges.frame<NT>(candidate[1]),
                                 stretching);
    });
    if (region) parts.push_back({stretching, std::move(*region)});
  }
  return parts;
}

FilteredRange TwoFingerContactRange(const TwoFingerPart& part, int k) {
  return FilteredRange(
      [&part, k](auto zero) { return TwoFingerRange(part.region.as<decltype(zero)>(), k); });
}

}  // namespace regrasp::polygon
