#include "planner/polygon/two_finger.h"

namespace regrasp {

namespace {

template <class NT>
ConvexRegion<NT> MakeSet(const EdgeFrame<NT>& a, const EdgeFrame<NT>& b, bool stretching) {
  const NT sign(stretching ? -1 : 1);
  // v = between + u_b · b.along − u_a · a.along must be on the left of both right borders and on
  // the right of both left borders.
  const Vector2<NT> between = b.a - a.a;
  auto region = ConvexRegion<NT>::UnitSquare();
  const auto clip_left_of = [&](const Vector2<NT>& direction) {
    region.Clip({-sign * Cross(direction, a.along), sign * Cross(direction, b.along),
                 sign * Cross(direction, between)});
  };
  clip_left_of(a.right);
  clip_left_of(-a.left);
  clip_left_of(-b.right);
  clip_left_of(b.left);
  return region;
}

template <class NT>
ContactRange<NT> MakeRange(const ConvexRegion<NT>& region, int k) {
  const auto parameter = [&](const HomogeneousPoint<NT>& p) {
    return Ratio<NT>::Make(k == 0 ? p.x : p.y, p.w);
  };
  Ratio<NT> low = parameter(region.sides().front().from);
  Ratio<NT> high = low;
  for (const auto& side : region.sides()) {
    low = Smaller(low, parameter(side.from));
    high = Larger(high, parameter(side.from));
  }
  return {low, high};
}

}  // namespace

std::vector<TwoFingerPart> FindTwoFingerSets(const EdgeTable& edges,
                                             const TwoFingerCandidate& candidate) {
  std::vector<TwoFingerPart> parts;
  for (const bool stretching : {false, true}) {
    auto region = FilteredRegion::Make([&edges, candidate, stretching](auto zero) {
      using NT = decltype(zero);
      return MakeSet(edges.frame<NT>(candidate[0]), edges.frame<NT>(candidate[1]), stretching);
    });
    if (region) parts.push_back({stretching, std::move(*region)});
  }
  return parts;
}

FilteredRange TwoFingerContactRange(const TwoFingerPart& part, int k) {
  return FilteredRange([&part, k](auto zero) {
    if constexpr (std::is_same_v<decltype(zero), Exact>) {
      return MakeRange(part.region.exact(), k);
    } else {
      return MakeRange(part.region.region(), k);
    }
  });
}

}  // namespace regrasp
