#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "planner/sets/polygon/plane.h"

namespace regrasp::polygon {

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
