#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "planner/sets/polygon/convex_region.h"

namespace regrasp::polygon {

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

  /// The same, with `by_intervals` as a faster equivalent of recipe(Interval(0)).
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

}  // namespace regrasp::polygon
