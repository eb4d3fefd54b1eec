#include "planner/sets/polygon/convex_region.h"

namespace regrasp::polygon {

namespace {

bool CertainlyPositive(const Interval& x) { return x.inf() > 0; }
bool CertainlyPositive(const Exact& x) { return CGAL::sign(x) == CGAL::POSITIVE; }
bool CertainlyNotPositive(const Interval& x) { return x.sup() <= 0; }
bool CertainlyNotPositive(const Exact& x) { return !CertainlyPositive(x); }

enum class Answer { kNo, kUncertain, kYes };

/// Return whether no point of `region` is strictly inside the half-plane of a side of another
/// region.
template <class NT>
Answer LiesOutside(const ConvexRegion<NT>& region,
                   const typename ConvexRegion<NT>::Side& separating) {
  Answer answer = Answer::kYes;
  const auto* previous = &region.sides().back();
  for (const auto& side : region.sides()) {
    const bool meets = previous->tag.MeetsAtPointOf(side.tag, separating.tag);
    previous = &side;
    if (meets) continue;
    const NT value = Evaluate(separating.half_plane, side.from);
    if (CertainlyPositive(value)) return Answer::kNo;
    if (!CertainlyNotPositive(value)) answer = Answer::kUncertain;
  }
  return answer;
}

/// Return whether two convex regions have a common interior.
/// They have none iff a side of one region has all of the second region outside.
template <class NT>
Answer Overlap(const ConvexRegion<NT>& a, const ConvexRegion<NT>& b) {
  Answer answer = Answer::kYes;
  const auto examine = [&](const ConvexRegion<NT>& with_side, const ConvexRegion<NT>& other) {
    for (const auto& side : with_side.sides()) {
      const Answer separates = LiesOutside(other, side);
      if (separates == Answer::kYes) return true;
      if (separates == Answer::kUncertain) answer = Answer::kUncertain;
    }
    return false;
  };
  return examine(a, b) || examine(b, a) ? Answer::kNo : answer;
}

Interval ToInterval(const Exact& x) { return Interval(CGAL::to_interval(x)); }

}  // namespace

const ConvexRegion<Exact>& FilteredRegion::exact() const {
  if (!exact_) {
    const ExactScope scope;
    exact_ = std::make_shared<const ConvexRegion<Exact>>(recipe_());
  }
  return *exact_;
}

bool FilteredRegion::Overlap(const FilteredRegion& a, const FilteredRegion& b) {
  if (a.box_.max_x <= b.box_.min_x || b.box_.max_x <= a.box_.min_x ||
      a.box_.max_y <= b.box_.min_y || b.box_.max_y <= a.box_.min_y) {
    return false;
  }
  const Answer answer = polygon::Overlap(a.region_, b.region_);
  if (answer != Answer::kUncertain) return answer == Answer::kYes;
  const ConvexRegion<Exact>& exact_a = a.exact();
  const ConvexRegion<Exact>& exact_b = b.exact();
  const ExactScope scope;
  return polygon::Overlap(exact_a, exact_b) == Answer::kYes;
}

std::optional<FilteredRegion> FilteredRegion::Round(ConvexRegion<Exact> region) {
  if (region.empty()) return std::nullopt;
  FilteredRegion made;
  made.region_ = region.Convert<Interval>(ToInterval);
  made.exact_ = std::make_shared<const ConvexRegion<Exact>>(std::move(region));
  made.FindBox();
  return made;
}

void FilteredRegion::FindBox() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const auto& side : region_.sides()) {
    if (!CertainlyPositive(side.from.w)) {
      box_ = {-kInfinity, kInfinity, -kInfinity, kInfinity};
      return;
    }
    const Interval x = side.from.x / side.from.w;
    const Interval y = side.from.y / side.from.w;
    box_.min_x = std::min(box_.min_x, x.inf());
    box_.max_x = std::max(box_.max_x, x.sup());
    box_.min_y = std::min(box_.min_y, y.inf());
    box_.max_y = std::max(box_.max_y, y.sup());
  }
}

}  // namespace regrasp::polygon
