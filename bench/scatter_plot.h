#pragma once

#include <string>
#include <utility>
#include <vector>

namespace regrasp {

/// Points over a linear x and a logarithmic y axis, in series of one colour each.
struct ScatterPlot {
  struct Series {
    std::string name;
    std::string color;  ///< as SVG writes it
    std::vector<std::pair<double, double>> points;
  };
  std::string x_title;
  std::string y_title;
  double x_from = 0;
  double x_to = 1;
  double y_from = 0.1;  ///< powers of ten; points outside are drawn at the border
  double y_to = 10;
  double level = 1;  ///< a dashed line across
  std::string level_name;
  std::vector<Series> series;
};

[[nodiscard]] std::string FormatScatterPlot(const ScatterPlot& plot);

}  // namespace regrasp
