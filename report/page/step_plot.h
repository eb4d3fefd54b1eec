#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/markup.h"

namespace regrasp::report {

struct PlotTick {
  double value = 0;
  std::string label;
};

/// The vertical axis of a plot: its ends and its ticks, all of them within the ends.
struct PlotAxis {
  double lower = 0;
  double upper = 1;
  bool logarithmic = false;
  std::vector<PlotTick> ticks;

  /// 0 at the lower end, 1 at the upper one; values beyond are held at the ends.
  [[nodiscard]] double Position(double value) const;
};

/// An axis from zero, or from below it, to a round number at or above all values.
/// @throws std::invalid_argument  a value is not finite.
[[nodiscard]] PlotAxis MakeLinearAxis(const std::vector<double>& values);

/// An axis of whole decades around all positive values, at least one and at most
/// kMostDecades; ticks at powers of ten.
/// @throws std::invalid_argument  a value is not finite.
[[nodiscard]] PlotAxis MakeLogAxis(const std::vector<double>& values);

/// What is smaller than the largest value by more than this lies on the axis's end.
inline constexpr int kMostDecades = 14;

/// "10⁻⁶".
[[nodiscard]] std::string FormatPowerOfTen(int exponent);

/// The smallest of 1, 2 or 5 times a power of ten that is no smaller than `least` (> 0).
[[nodiscard]] double RoundStep(double least);

/// How the points of a series look; the shapes tell them apart without colour.
enum class PlotMark { kDisc, kRing };

/// A value for each step; none where a step has none.
struct PlotSeries {
  std::string name;
  std::vector<std::optional<double>> values;
  PlotMark mark = PlotMark::kDisc;
};

/// A horizontal line that the values should stay on one side of.
struct PlotLimit {
  double value = 0;
  std::string label;
  bool from_above = true;  ///< values above it are bad, otherwise those below it
};

/// A plot over the steps of a plan.
struct StepPlot {
  std::string title;   ///< for readers who do not see the picture
  std::string y_axis;  ///< quantity and unit
  bool logarithmic = false;
  std::vector<PlotSeries> series;  ///< at least one, all of the same length
  std::optional<PlotLimit> limit;
  /// The step that failed; marked, and what follows is shaded.
  std::optional<int> failed;
};

/// The plot as an inline SVG element, without scripts, styled by the page it stands in (classes
/// axis, grid, limit, beyond, series0, series1, …). On a logarithmic axis values that are not
/// positive lie on its lower end. Same plot, same bytes.
/// @throws std::invalid_argument  no series, different lengths, no step, or a value is not finite.
[[nodiscard]] Element DrawStepPlot(const StepPlot& plot);

}  // namespace regrasp::report
