#include "bench/scatter_plot.h"

#include <algorithm>
#include <cmath>

#include "planner/base/number.h"

namespace regrasp {

namespace {

constexpr double kWidth = 760;
constexpr double kHeight = 470;
constexpr double kLeft = 78;
constexpr double kRight = 16;
constexpr double kTop = 52;
constexpr double kBottom = 56;
constexpr double kRadius = 1.7;
constexpr double kTickStep = 0.1;

std::string Number(double value) { return FormatFixed(value, 1); }

/// Coordinate axes: map values to image coordinates.
class Axes {
 public:
  explicit Axes(const ScatterPlot& plot) : plot_(plot) {}

  [[nodiscard]] double X(double x) const {
    return kLeft + (kWidth - kLeft - kRight) * (x - plot_.x_from) / (plot_.x_to - plot_.x_from);
  }
  [[nodiscard]] double Y(double y) const {
    const double inside = std::clamp(y, plot_.y_from, plot_.y_to);
    const double share = std::log(inside / plot_.y_from) / std::log(plot_.y_to / plot_.y_from);
    return kHeight - kBottom - (kHeight - kTop - kBottom) * share;
  }

 private:
  const ScatterPlot& plot_;
};

std::string Line(double x1, double y1, double x2, double y2, const std::string& style) {
  return "<line x1=\"" + Number(x1) + "\" y1=\"" + Number(y1) + "\" x2=\"" + Number(x2) +
         "\" y2=\"" + Number(y2) + "\" " + style + "/>\n";
}

std::string Text(double x, double y, const std::string& text, const std::string& style) {
  return "<text x=\"" + Number(x) + "\" y=\"" + Number(y) + "\" " + style + ">" + text +
         "</text>\n";
}

std::string Grid(const ScatterPlot& plot, const Axes& axes) {
  const std::string grid = "stroke=\"#d8dce2\" stroke-width=\"1\"";
  std::string svg;
  const int steps = static_cast<int>(std::lround((plot.x_to - plot.x_from) / kTickStep));
  for (int i = 0; i <= steps; ++i) {
    const double x = plot.x_from + i * kTickStep;
    svg += Line(axes.X(x), kTop, axes.X(x), kHeight - kBottom, grid);
    svg += Text(axes.X(x), kHeight - kBottom + 18, FormatFixed(x, 1), "text-anchor=\"middle\"");
  }
  const int first = static_cast<int>(std::lround(std::log10(plot.y_from)));
  const int last = static_cast<int>(std::lround(std::log10(plot.y_to)));
  for (int power = first; power <= last; ++power) {
    const double y = axes.Y(std::pow(10.0, power));
    svg += Line(kLeft, y, kWidth - kRight, y, grid);
    svg += Text(kLeft - 8, y + 4,
                "10<tspan dy=\"-5\" font-size=\"9\">" + std::to_string(power) + "</tspan>",
                "text-anchor=\"end\"");
  }
  return svg;
}

/// Return the legend in one or more rows. The fonts of browsers differ in width.
std::string Legend(const ScatterPlot& plot) {
  constexpr double kWidestLetter = 7.2, kMark = 14, kGap = 20, kRow = 18;
  std::string svg;
  double x = kLeft, y = 14;
  for (const ScatterPlot::Series& series : plot.series) {
    const double width = kMark + kWidestLetter * static_cast<double>(series.name.size());
    if (x > kLeft && x + width > kWidth) {
      x = kLeft;
      y += kRow;
    }
    svg += "<circle cx=\"" + Number(x + 5) + "\" cy=\"" + Number(y) + "\" r=\"4\" fill=\"" +
           series.color + "\"/>\n" + Text(x + kMark, y + 4, series.name, "");
    x += width + kGap;
  }
  return svg;
}

}  // namespace

std::string FormatScatterPlot(const ScatterPlot& plot) {
  const Axes axes(plot);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + Number(kWidth) +
                    " " + Number(kHeight) +
                    "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\" "
                    "fill=\"#222834\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  svg += Grid(plot, axes) + Legend(plot);
  for (const ScatterPlot::Series& series : plot.series) {
    svg += "<g fill=\"" + series.color + "\" fill-opacity=\"0.55\">\n";
    for (const auto& [x, y] : series.points) {
      svg += "<circle cx=\"" + Number(axes.X(x)) + "\" cy=\"" + Number(axes.Y(y)) + "\" r=\"" +
             Number(kRadius) + "\"/>\n";
    }
    svg += "</g>\n";
  }
  const double level = axes.Y(plot.level);
  svg += Line(kLeft, level, kWidth - kRight, level,
              "stroke=\"#222834\" stroke-width=\"1.2\" stroke-dasharray=\"6 4\"");
  svg += Text(kWidth - kRight - 4, level - 6, plot.level_name, "text-anchor=\"end\"");
  svg += Text((kLeft + kWidth - kRight) / 2, kHeight - 14, plot.x_title, "text-anchor=\"middle\"");
  const double middle = (kTop + kHeight - kBottom) / 2;
  svg += Text(18, middle, plot.y_title,
              "text-anchor=\"middle\" transform=\"rotate(-90 18 " + Number(middle) + ")\"");
  return svg + "</svg>\n";
}

}  // namespace regrasp
