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

/// Vertical axis of a plot: its ends and its ticks, which are within the ends.
struct PlotAxis {
  double lower = 0;
  double upper = 1;
  bool logarithmic = false;
  std::vector<PlotTick> ticks;

  /// Return 0 at the lower end and 1 at the upper end; values beyond are clamped.
  [[nodiscard]] double Position(double value) const;
};

/// Return an axis from zero, or from below it, to a round number at or above all values.
/// @throws std::invalid_argument  if a value is not finite.
[[nodiscard]] PlotAxis MakeLinearAxis(const std::vector<double>& values);

/// Return an axis of whole decades around all positive values, with ticks at powers of ten.
/// It has at least one decade and at most kMostDecades.
/// @throws std::invalid_argument  if a value is not finite.
[[nodiscard]] PlotAxis MakeLogAxis(const std::vector<double>& values);

/// Largest number of decades; values further below the largest one are on the end of the axis.
inline constexpr int kMostDecades = 14;

/// Return a power of ten as text, "10⁻⁶".
[[nodiscard]] std::string FormatPowerOfTen(int exponent);

/// Return the smallest of 1, 2 or 5 times a power of ten that is at least `least` (> 0).
[[nodiscard]] double RoundStep(double least);

/// Marks of a series; their shapes distinguish series without colour.
enum class PlotMark { kDisc, kRing };

/// A value per step; none if a step has none.
struct PlotSeries {
  std::string name;
  std::vector<std::optional<double>> values;
  PlotMark mark = PlotMark::kDisc;
};

/// A horizontal line that separates good values from bad ones.
struct PlotLimit {
  double value = 0;
  std::string label;
  bool from_above = true;  ///< whether values above the line are bad; otherwise those below it
};

/// A plot over the steps of a plan.
struct StepPlot {
  std::string title;               ///< description for readers who cannot see the plot
  std::string y_axis;              ///< quantity and unit
  bool logarithmic = false;        ///< for lengths in metres: each tick has a unit of its own
  std::vector<PlotSeries> series;  ///< one or more series of equal length
  std::optional<PlotLimit> limit;
  /// The step that failed. It is marked, and later steps are shaded.
  std::optional<int> failed;
};

/// Return the plot as an inline SVG element without scripts.
/// The page styles it (classes axis, grid, limit, beyond, series0, series1, …). On a logarithmic
/// axis, values that are not positive are on the lower end. The same plot gives the same bytes.
/// @throws std::invalid_argument  if there is no series or no step, lengths differ, or a value is
///     not finite.
[[nodiscard]] Element DrawStepPlot(const StepPlot& plot);

}  // namespace regrasp::report
