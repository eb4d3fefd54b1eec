#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/markup.h"

namespace regrasp::report {

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
