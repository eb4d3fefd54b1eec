#include "planner/object/segment.h"

#include <algorithm>
#include <numbers>

namespace regrasp::object {

namespace {

/// Number of bisections of [0, 1] to the precision of double.
constexpr int kBisections = 54;
/// Number of golden sections to the same precision.
constexpr int kGoldenSections = 78;

/// Return a point within the threshold, or the lowest point of a golden section search.
double FindLow(const std::function<double(double)>& distance, double threshold) {
  const double ratio = std::numbers::phi - 1;
  double low = 0, high = 1;
  double left = high - ratio, right = low + ratio;
  double at_left = distance(left), at_right = distance(right);
  for (int i = 0; i < kGoldenSections; ++i) {
    if (at_left <= threshold) return left;
    if (at_right <= threshold) return right;
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - ratio * (high - low);
      at_left = distance(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + ratio * (high - low);
      at_right = distance(right);
    }
  }
  return at_left < at_right ? left : right;
}

/// Return the last point within the threshold on the path from `inside` to `end`.
double FindEnd(const std::function<double(double)>& distance, double threshold, double inside,
               double end) {
  if (distance(end) <= threshold) return end;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = (inside + end) / 2;
    (distance(middle) <= threshold ? inside : end) = middle;
  }
  return inside;
}

}  // namespace

std::optional<ParameterInterval> SublevelInterval(const std::function<double(double)>& distance,
                                                  double threshold) {
  for (const double end : {0.0, 1.0}) {
    if (distance(end) > threshold) continue;
    const double other = FindEnd(distance, threshold, end, 1 - end);
    return std::minmax(end, other);
  }
  const double low = FindLow(distance, threshold);
  if (distance(low) > threshold) return std::nullopt;
  return ParameterInterval{FindEnd(distance, threshold, low, 0),
                           FindEnd(distance, threshold, low, 1)};
}

bool CoverUnitInterval(std::vector<ParameterInterval> intervals) {
  std::ranges::sort(intervals);
  double covered = 0;
  for (const auto& [from, to] : intervals) {
    if (from > covered) return false;
    covered = std::max(covered, to);
  }
  return covered >= 1 && !intervals.empty();
}

}  // namespace regrasp::object
