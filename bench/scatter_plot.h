#pragma once

#include <string>
#include <utility>
#include <vector>

namespace regrasp {

/// Scatter plot with a linear x axis and a logarithmic y axis. Each series has one colour.
struct ScatterPlot {
  struct Series {
    std::string name;
    std::string color;  ///< SVG colour
    std::vector<std::pair<double, double>> points;
  };
  std::string x_title;
  std::string y_title;
  double x_from = 0;
  double x_to = 1;
  double y_from = 0.1;  ///< lower limit, a power of ten; points outside are drawn at the border
  double y_to = 10;
  double level = 1;  ///< y of a dashed horizontal line
  std::string level_name;
  std::vector<Series> series;
};

[[nodiscard]] std::string FormatScatterPlot(const ScatterPlot& plot);

}  // namespace regrasp
