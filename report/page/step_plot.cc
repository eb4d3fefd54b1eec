#include "report/page/step_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "planner/base/number.h"
#include "report/page/html_page.h"

namespace regrasp::report {

namespace {

/// Largest number of ticks.
constexpr int kMostTicks = 6;

/// Distance from a whole number within which a quotient is rounded: 0.3 / 0.1 is slightly below 3.
constexpr double kWhole = 1e-9;

void CheckFinite(const std::vector<double>& values) {
  if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); })) {
    throw std::invalid_argument("plot axis: a value is not finite");
  }
}

}  // namespace

double PlotAxis::Position(double value) const {
  const auto along = [&](double v) { return logarithmic ? std::log10(v) : v; };
  if (value <= lower) return 0;
  return std::min(1.0, (along(value) - along(lower)) / (along(upper) - along(lower)));
}

double RoundStep(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= least * (1 - kWhole)) return digit * power;
  }
  return 10 * power;
}

PlotAxis MakeLinearAxis(const std::vector<double>& values) {
  CheckFinite(values);
  double least = 0, most = 0;
  for (const double value : values) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  if (most == least) most = least + 1;
  const double step = RoundStep((most - least) / (kMostTicks - 1));
  const auto first = static_cast<int>(std::floor(least / step + kWhole));
  const auto last = static_cast<int>(std::ceil(most / step - kWhole));
  PlotAxis axis = {first * step, last * step, /*logarithmic=*/false, {}};
  for (int i = first; i <= last; ++i) axis.ticks.push_back({i * step, FormatShort(i * step)});
  return axis;
}

PlotAxis MakeLogAxis(const std::vector<double>& values) {
  CheckFinite(values);
  double least = 0, most = 0;
  for (const double value : values) {
    if (!(value > 0)) continue;
    least = least == 0 ? value : std::min(least, value);
    most = std::max(most, value);
  }
  if (most == 0) least = most = 1;
  const auto upper = static_cast<int>(std::ceil(std::log10(most) - kWhole));
  auto lower = static_cast<int>(std::floor(std::log10(least) + kWhole));
  lower = std::clamp(lower, upper - kMostDecades, upper - 1);
  PlotAxis axis = {std::pow(10.0, lower), std::pow(10.0, upper), /*logarithmic=*/true, {}};
  const int stride = (upper - lower + kMostTicks - 1) / kMostTicks;
  for (int exponent = upper; exponent >= lower; exponent -= stride) {
    axis.ticks.push_back({std::pow(10.0, exponent), FormatPowerOfTen(exponent)});
  }
  return axis;
}

std::string FormatPowerOfTen(int exponent) {
  static constexpr std::array<const char*, 10> kDigits = {"⁰", "¹", "²", "³", "⁴",
                                                          "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = "10";
  for (const char c : std::to_string(exponent)) text += c == '-' ? "⁻" : kDigits[c - '0'];
  return text;
}

namespace {

// Units of the image; at the usual column width, one is about a pixel.
constexpr double kWidth = 480;
constexpr double kHeight = 280;
constexpr double kLeft = 80;
constexpr double kRight = 12;
constexpr double kTop = 30;
constexpr double kBottom = 46;
constexpr double kMarkRadius = 3.6;
constexpr double kTickGap = 6;     ///< between an axis and its numbers
constexpr double kHalfFont = 4.5;  ///< from the middle of a line of text to its baseline

/// Largest number of labels on the horizontal axis.
constexpr int kMostStepLabels = 12;
/// Largest number of marks on a line; a line with more is drawn without marks.
constexpr std::size_t kMostMarks = 60;

constexpr int kDecimals = 2;

std::string Number(double value) { return FormatFixed(value, kDecimals); }

Element Line(std::string_view style, double x1, double y1, double x2, double y2) {
  return Element("line", {{"class", std::string(style)},
                          {"x1", Number(x1)},
                          {"y1", Number(y1)},
                          {"x2", Number(x2)},
                          {"y2", Number(y2)}});
}

Element Box(std::string_view style, double x, double y, double width, double height) {
  return Element("rect", {{"class", std::string(style)},
                          {"x", Number(x)},
                          {"y", Number(y)},
                          {"width", Number(width)},
                          {"height", Number(height)}});
}

/// @param anchor  "start", "middle" or "end".
Element Text(std::string_view anchor, double x, double y, std::string_view text,
             const Attributes& more = {}) {
  Attributes attributes = {
      {"x", Number(x)}, {"y", Number(y)}, {"text-anchor", std::string(anchor)}};
  attributes.insert(attributes.end(), more.begin(), more.end());
  return Element("text", attributes, text);
}

class Drawing {
 public:
  explicit Drawing(const StepPlot& plot)
      : plot_(plot), steps_(plot.series.front().values.size()), axis_(MakeAxis(plot)) {}

  [[nodiscard]] Element Draw() const {
    Element svg("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                        {"role", "img"},
                        {"viewBox", "0 0 " + FormatShort(kWidth) + " " + FormatShort(kHeight)}});
    svg.Add(Element("title", {}, plot_.title));
    AddSkipped(svg);
    AddBeyond(svg);
    AddVerticalAxis(svg);
    AddStepAxis(svg);
    AddLimit(svg);
    for (std::size_t i = 0; i < plot_.series.size(); ++i) svg.Add(Series(i));
    svg.Add(Legend());
    return svg;
  }

 private:
  static PlotAxis MakeAxis(const StepPlot& plot) {
    std::vector<double> values;
    for (const PlotSeries& series : plot.series) {
      for (const std::optional<double>& value : series.values) {
        if (value) values.push_back(*value);
      }
    }
    if (plot.limit) values.push_back(plot.limit->value);
    return plot.logarithmic ? MakeLogAxis(values) : MakeLinearAxis(values);
  }

  [[nodiscard]] double X(double step) const {
    return kLeft + (step + 0.5) / static_cast<double>(steps_) * (kWidth - kLeft - kRight);
  }
  [[nodiscard]] double Y(double value) const {
    return kHeight - kBottom - axis_.Position(value) * (kHeight - kBottom - kTop);
  }

  /// Shade the steps after the failure.
  void AddSkipped(Element& svg) const {
    if (!plot_.failed || *plot_.failed + 1 >= static_cast<int>(steps_)) return;
    const double from = X(*plot_.failed + 0.5);
    svg.Add(Box("skipped", from, kTop, kWidth - kRight - from, kHeight - kBottom - kTop));
  }

  /// Shade the bad side of the limit.
  void AddBeyond(Element& svg) const {
    if (!plot_.limit) return;
    const double y = Y(plot_.limit->value);
    const double from = plot_.limit->from_above ? kTop : y;
    const double to = plot_.limit->from_above ? y : kHeight - kBottom;
    svg.Add(Box("beyond", kLeft, from, kWidth - kLeft - kRight, to - from));
  }

  void AddVerticalAxis(Element& svg) const {
    for (const PlotTick& tick : axis_.ticks) {
      const double y = Y(tick.value);
      svg.Add(Line("grid", kLeft, y, kWidth - kRight, y));
      const std::string label = plot_.logarithmic ? FormatLength(tick.value, 1) : tick.label;
      svg.Add(Text("end", kLeft - kTickGap, y + kHalfFont, label));
    }
    const double middle = (kTop + kHeight - kBottom) / 2;
    svg.Add(Text("middle", 0, 0, plot_.y_axis,
                 {{"transform", "translate(14 " + Number(middle) + ") rotate(-90)"}}));
  }

  void AddStepAxis(Element& svg) const {
    const double base = kHeight - kBottom;
    svg.Add(Line("axis", kLeft, base, kWidth - kRight, base));
    const double least = static_cast<double>(steps_) / kMostStepLabels;
    const int stride = std::max(1, static_cast<int>(std::lround(RoundStep(least))));
    for (std::size_t step = 0; step < steps_; step += stride) {
      const double x = X(static_cast<double>(step));
      svg.Add(Line("axis", x, base, x, base + kTickGap / 2));
      svg.Add(Text("middle", x, base + kTickGap + 2.5 * kHalfFont, std::to_string(step)));
    }
    svg.Add(Text("middle", (kLeft + kWidth - kRight) / 2, kHeight - kTickGap, "step"));
  }

  void AddLimit(Element& svg) const {
    if (!plot_.limit) return;
    const double y = Y(plot_.limit->value);
    svg.Add(Line("limit", kLeft, y, kWidth - kRight, y));
    if (plot_.limit->label.empty()) return;
    // The label is above the line, because values of a passing plan are below it, unless it does
    // not fit.
    const double above = y - kHalfFont, below = y + 3 * kHalfFont;
    const double text = above - 2 * kHalfFont < kTop ? below : above;
    svg.Add(
        Text("end", kWidth - kRight - kTickGap, text, plot_.limit->label, {{"class", "limit"}}));
  }

  [[nodiscard]] Element Series(std::size_t index) const {
    const PlotSeries& series = plot_.series[index];
    std::string path;
    std::vector<Element> marks;
    bool drawing = false;
    for (std::size_t step = 0; step < steps_; ++step) {
      if (!series.values[step]) {
        drawing = false;
        continue;
      }
      const double x = X(static_cast<double>(step)), y = Y(*series.values[step]);
      path += (drawing ? "L" : "M") + Number(x) + " " + Number(y);
      drawing = true;
      if (steps_ <= kMostMarks || IsFailed(step)) {
        marks.push_back(Mark(series.mark, x, y, IsFailed(step)));
      }
    }
    return Element("g", {{"class", StyleOf(index)}}, Element("path", {{"d", path}}), marks);
  }

  [[nodiscard]] bool IsFailed(std::size_t step) const {
    return plot_.failed && *plot_.failed == static_cast<int>(step);
  }

  static std::string StyleOf(std::size_t index) { return "series" + std::to_string(index); }

  static Element Mark(PlotMark mark, double x, double y, bool failed) {
    std::string style = mark == PlotMark::kDisc ? "disc" : "ring";
    if (failed) style += " failed";
    return Element(
        "circle",
        {{"class", style}, {"cx", Number(x)}, {"cy", Number(y)}, {"r", Number(kMarkRadius)}});
  }

  static Element KeyOf(PlotMark mark, const std::string& style) {
    return Element("tspan", {{"class", style}}, mark == PlotMark::kDisc ? "●" : "○");
  }

  /// Names above the plot, each after its mark. They are one text, so that they never overlap.
  [[nodiscard]] Element Legend() const {
    constexpr double kBase = 16;
    Element names("text", {{"x", Number(kLeft)}, {"y", Number(kBase)}});
    for (std::size_t i = 0; i < plot_.series.size(); ++i) {
      const PlotSeries& series = plot_.series[i];
      if (i > 0) names.Add("\u2003");
      names.Add(KeyOf(series.mark, StyleOf(i)));
      names.Add("\u2009" + series.name);
    }
    return names;
  }

  const StepPlot& plot_;
  std::size_t steps_;
  PlotAxis axis_;
};

}  // namespace

Element DrawStepPlot(const StepPlot& plot) {
  if (plot.series.empty() || plot.series.front().values.empty()) {
    throw std::invalid_argument("DrawStepPlot: nothing to plot");
  }
  for (const PlotSeries& series : plot.series) {
    if (series.values.size() != plot.series.front().values.size()) {
      throw std::invalid_argument("DrawStepPlot: series of different lengths");
    }
  }
  return Drawing(plot).Draw();
}

}  // namespace regrasp::report
