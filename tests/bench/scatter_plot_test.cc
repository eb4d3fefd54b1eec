#include "bench/scatter_plot.h"

#include <gtest/gtest.h>

#include <regex>
#include <string>

namespace regrasp {
namespace scatter_plot_test {

/// The width of the image in FormatScatterPlot's view box.
double WidthOf(const std::string& svg) {
  std::smatch match;
  EXPECT_TRUE(std::regex_search(svg, match, std::regex("viewBox=\"0 0 ([0-9.]+) ")));
  return std::stod(match[1]);
}

ScatterPlot PlotOf(int series, const std::string& name) {
  ScatterPlot plot;
  for (int i = 0; i < series; ++i) {
    plot.series.push_back({name, "#123456", {{0.5, 1}}});
  }
  return plot;
}

TEST(ScatterPlot, EntriesOfTheLegendAreInsideTheImageAndApart) {
  const std::string name = "a name of thirty-two characters.";
  constexpr double kNarrowestLetter = 5;  // units of the image, mean width in narrow fonts
  const std::string svg = FormatScatterPlot(PlotOf(5, name));
  const std::regex entry("<text x=\"([0-9.]+)\" y=\"([0-9.]+)\" >" + name);
  double x_before = 0, y_before = -1;
  int entries = 0, rows = 0;
  for (std::sregex_iterator i(svg.begin(), svg.end(), entry), end; i != end; ++i) {
    const double x = std::stod((*i)[1]), y = std::stod((*i)[2]);
    const double length = kNarrowestLetter * static_cast<double>(name.size());
    EXPECT_LT(x + length, WidthOf(svg));
    if (y == y_before) {
      EXPECT_GT(x, x_before + length);
    } else {
      EXPECT_GT(y, y_before);
      ++rows;
    }
    x_before = x;
    y_before = y;
    ++entries;
  }
  EXPECT_EQ(entries, 5);
  EXPECT_GT(rows, 1);
}

TEST(ScatterPlot, PointsOutsideTheAxisAreAtItsBorder) {
  const auto height_of = [](double y) {
    ScatterPlot plot = PlotOf(1, "s");
    plot.series[0].points = {{0.5, y}};
    const std::string svg = FormatScatterPlot(plot);
    const std::size_t group = svg.find("<g fill");
    std::smatch match;
    const std::string rest = svg.substr(group);
    EXPECT_TRUE(std::regex_search(rest, match, std::regex("cy=\"([0-9.]+)\"")));
    return std::stod(match[1]);
  };
  EXPECT_EQ(height_of(1e6), height_of(10));
  EXPECT_EQ(height_of(1e-6), height_of(0.1));
  EXPECT_LT(height_of(5), height_of(1));
}

}  // namespace scatter_plot_test
}  // namespace regrasp
