#pragma once

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "planner/sets/polygon/plane.h"

namespace regrasp::polygon {

/// Known properties of a half-plane that avoid computations.
struct SideTag {
  int id = -1;  ///< identifier of the side, set by the caller
  /// Points on the border by construction, −1 for none. If two sides meet in such a point that is
  /// also on the border of a third, its sign there is 0 without a computation. Edges that share a
  /// vertex are the one degeneracy that every polygon has.
  std::array<int, 2> through = {-1, -1};

  [[nodiscard]] bool Passes(int point) const {
    return point >= 0 && (through[0] == point || through[1] == point);
  }
  [[nodiscard]] bool MeetsAtPointOf(const SideTag& next, const SideTag& third) const {
    return std::any_of(through.begin(), through.end(),
                       [&](int p) { return next.Passes(p) && third.Passes(p); });
  }
};

/// Intersection of half-planes: a convex region with interior, possibly unbounded, or empty.
///
/// The representation lists the half-planes of the border counter-clockwise, without redundant
/// ones, each with the corner at its start. In homogeneous coordinates the region is a pointed cone
/// between planes through the origin. Corners at infinity therefore need no special case, and every
/// decision is the sign of a half-plane at a corner: a 3 × 3 determinant.
template <class NT>
class ConvexRegion {
 public:
  struct Side {
    HalfPlane<NT> half_plane;
    SideTag tag;
    HomogeneousPoint<NT> from;  ///< start of the side
  };

  /// Make the intersection of four half-planes that bound a convex quadrilateral in this order,
  /// counter-clockwise. One of them may be the line at infinity {0, 0, 1}.
  ConvexRegion(const std::array<HalfPlane<NT>, 4>& half_planes,
               const std::array<SideTag, 4>& tags) {
    sides_.reserve(kUsualSides);
    for (int k = 0; k < 4; ++k) {
      sides_.push_back({half_planes[k], tags[k], Corner(half_planes[(k + 3) % 4], half_planes[k])});
    }
  }

  /// Return [0, 1] × [0, 1].
  static ConvexRegion UnitSquare() {
    const NT zero(0);
    const NT one(1);
    return ConvexRegion(
        {HalfPlane<NT>{zero, one, zero}, {-one, zero, one}, {zero, -one, one}, {one, zero, zero}},
        {});
  }

  /// Make an empty region.
  ConvexRegion() = default;

  /// Convert the region to another number type.
  template <class To, class Map>
  [[nodiscard]] ConvexRegion<To> Convert(const Map& map) const {
    std::vector<typename ConvexRegion<To>::Side> sides;
    for (const Side& s : sides_) {
      sides.push_back({{map(s.half_plane.a), map(s.half_plane.b), map(s.half_plane.c)},
                       s.tag,
                       {map(s.from.x), map(s.from.y), map(s.from.w)}});
    }
    return ConvexRegion<To>(std::move(sides));
  }

  [[nodiscard]] bool empty() const { return sides_.empty(); }
  [[nodiscard]] const std::vector<Side>& sides() const { return sides_; }
  [[nodiscard]] bool HasSide(int id) const {
    return std::any_of(sides_.begin(), sides_.end(), [&](const Side& s) { return s.tag.id == id; });
  }

  /// Intersect the region with a half-plane; the result is empty if no interior remains.
  void Clip(const HalfPlane<NT>& half_plane, const SideTag& tag = {}) {
    const int n = static_cast<int>(sides_.size());
    if (n == 0) return;
    boost::container::small_vector<signed char, kUsualSides> signs(n);
    bool inside = false;
    bool outside = false;
    for (int k = 0; k < n; ++k) {
      const bool meets = sides_[(k + n - 1) % n].tag.MeetsAtPointOf(sides_[k].tag, tag);
      const int sign = meets ? 0 : Sign(Evaluate(half_plane, sides_[k].from));
      signs[k] = static_cast<signed char>(sign);
      inside = inside || sign > 0;
      outside = outside || sign < 0;
    }
    if (!outside) return;
    if (!inside) {
      sides_.clear();
      return;
    }
    // A side remains iff one of its ends is strictly inside. The remaining sides are consecutive,
    // and the new side closes the border between the last and the first.
    const auto is_inside = [&](int k) { return signs[k % n] > 0; };
    int first = 0;
    while (is_inside(first) || !is_inside(first + 1)) ++first;
    int count = 1;
    while (is_inside(first + count)) ++count;
    std::rotate(sides_.begin(), sides_.begin() + first, sides_.end());
    sides_.erase(sides_.begin() + count, sides_.end());
    sides_.front().from = Corner(half_plane, sides_.front().half_plane);
    sides_.push_back({half_plane, tag, Corner(sides_.back().half_plane, half_plane)});
  }

 private:
  template <class>
  friend class ConvexRegion;

  explicit ConvexRegion(std::vector<Side> sides) : sides_(std::move(sides)) {}

  static constexpr int kUsualSides = 8;

  std::vector<Side> sides_;
};

/// Convex region with exact combinatorics and interval coordinates.
///
/// Exact coordinates are computed only if a decision needs them. Use it in an IntervalScope.
class FilteredRegion {
 public:
  /// Make a region by intervals, or exactly if they cannot decide.
  /// @param recipe  function of a zero of either number type NT that returns a ConvexRegion<NT>. It
  ///     may throw the same exceptions as Sign. Its captures must outlive the region.
  /// @returns nullopt if the region is empty.
  template <class Recipe>
  static std::optional<FilteredRegion> Make(const Recipe& recipe) {
    return Make(recipe, [&] { return recipe(Interval(0)); });
  }

  /// Overload with `by_intervals` as a faster equivalent of recipe(Interval(0)).
  template <class Recipe, class ByIntervals>
  static std::optional<FilteredRegion> Make(const Recipe& recipe, const ByIntervals& by_intervals) {
    try {
      ConvexRegion<Interval> region = by_intervals();
      if (region.empty()) return std::nullopt;
      FilteredRegion made;
      made.region_ = std::move(region);
      made.recipe_ = [recipe] { return recipe(Exact(0)); };
      made.FindBox();
      return made;
    } catch (const CGAL::Uncertain_conversion_exception&) {
    }
    const ExactScope scope;
    return Round(recipe(Exact(0)));
  }

  [[nodiscard]] const ConvexRegion<Interval>& region() const { return region_; }
  [[nodiscard]] const ConvexRegion<Exact>& exact() const;
  template <class NT>
  [[nodiscard]] const ConvexRegion<NT>& as() const {
    if constexpr (std::is_same_v<NT, Exact>) {
      return exact();
    } else {
      return region();
    }
  }

  /// Return whether two regions have a common interior.
  [[nodiscard]] static bool Overlap(const FilteredRegion& a, const FilteredRegion& b);

 private:
  FilteredRegion() = default;
  static std::optional<FilteredRegion> Round(ConvexRegion<Exact> region);
  void FindBox();

  struct Box {
    double min_x = std::numeric_limits<double>::infinity();
    double max_x = -std::numeric_limits<double>::infinity();
    double min_y = std::numeric_limits<double>::infinity();
    double max_y = -std::numeric_limits<double>::infinity();
  };

  ConvexRegion<Interval> region_;
  Box box_;  ///< bounding box, which avoids most tests
  std::function<ConvexRegion<Exact>()> recipe_;
  mutable std::shared_ptr<const ConvexRegion<Exact>> exact_;
};

/// A quotient, represented by an interval or exactly.
template <class NT>
struct Ratio;

template <>
struct Ratio<Interval> {
  Interval value;

  static Ratio Make(const Interval& numerator, const Interval& denominator) {
    if (denominator.inf() > 0) return {numerator / denominator};
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {{-kInfinity, kInfinity}};
  }
  friend bool operator<(const Ratio& a, const Ratio& b) { return a.value < b.value; }
};

template <>
struct Ratio<Exact> {
  Exact numerator;
  Exact denominator;  ///< >= 0; 0 for an infinite value

  static Ratio Make(const Exact& numerator, const Exact& denominator) {
    return {numerator, denominator};
  }
  friend bool operator<(const Ratio& a, const Ratio& b) {
    return Sign(a.numerator * b.denominator - b.numerator * a.denominator) < 0;
  }
};

/// For intervals, return an interval that contains the smaller value, without a decision.
inline Ratio<Interval> Smaller(const Ratio<Interval>& a, const Ratio<Interval>& b) {
  return {{std::min(a.value.inf(), b.value.inf()), std::min(a.value.sup(), b.value.sup())}};
}
inline Ratio<Interval> Larger(const Ratio<Interval>& a, const Ratio<Interval>& b) {
  return {{std::max(a.value.inf(), b.value.inf()), std::max(a.value.sup(), b.value.sup())}};
}
inline Ratio<Exact> Smaller(const Ratio<Exact>& a, const Ratio<Exact>& b) { return b < a ? b : a; }
inline Ratio<Exact> Larger(const Ratio<Exact>& a, const Ratio<Exact>& b) { return a < b ? b : a; }

/// Open interval of an edge's parameter, 0 to 1, that contains the possible contacts of a grasp
/// set.
template <class NT>
struct ContactRange {
  Ratio<NT> low;
  Ratio<NT> high;

  /// Return the part of [low, high] on the edge.
  static ContactRange OnEdge(const Ratio<NT>& low, const Ratio<NT>& high) {
    return {Larger(low, Ratio<NT>::Make(NT(0), NT(1))),
            Smaller(high, Ratio<NT>::Make(NT(1), NT(1)))};
  }
  [[nodiscard]] ContactRange Join(const ContactRange& other) const {
    return {Smaller(low, other.low), Larger(high, other.high)};
  }
  [[nodiscard]] bool Overlaps(const ContactRange& other) const {
    return low < other.high && other.low < high;
  }
};

/// Range whose exact ends are computed only if a decision needs them. Use it in an IntervalScope.
class FilteredRange {
 public:
  /// @param recipe  function of a zero of either number type NT that returns a ContactRange<NT>.
  template <class Recipe>
  explicit FilteredRange(Recipe recipe)
      : range_(ByIntervals(recipe)), exactly_([recipe] { return recipe(Exact(0)); }) {}

  [[nodiscard]] const ContactRange<Interval>& by_intervals() const { return range_; }
  /// Return the exact range. Call it in an ExactScope.
  [[nodiscard]] ContactRange<Exact> exact() const { return exactly_(); }

  /// Return whether two ranges of one edge have a common contact.
  [[nodiscard]] static bool Overlap(const FilteredRange& a, const FilteredRange& b) {
    try {
      return a.range_.Overlaps(b.range_);
    } catch (const CGAL::Uncertain_conversion_exception&) {
    }
    const ExactScope scope;
    return a.exactly_().Overlaps(b.exactly_());
  }

 private:
  template <class Recipe>
  static ContactRange<Interval> ByIntervals(const Recipe& recipe) {
    try {
      return recipe(Interval(0));
    } catch (const CGAL::Uncertain_conversion_exception&) {
    }
    const ExactScope scope;
    const ContactRange<Exact> exact = recipe(Exact(0));
    const auto round = [](const Ratio<Exact>& r) {
      return Ratio<Interval>::Make(CGAL::to_interval(r.numerator),
                                   CGAL::to_interval(r.denominator));
    };
    return {round(exact.low), round(exact.high)};
  }

  ContactRange<Interval> range_;
  std::function<ContactRange<Exact>()> exactly_;
};

}  // namespace regrasp::polygon
