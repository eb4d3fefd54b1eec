#include "report/page/step_plot.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planner/base/markup.h"
#include "planner/base/number.h"
#include "report/page/data_uri.h"
#include "report/page/plot_axis.h"

namespace regrasp {

namespace {

// Units of the picture: at the usual width of a column one of them is about a pixel.
constexpr double kWidth = 480;
constexpr double kHeight = 280;
constexpr double kLeft = 62;
constexpr double kRight = 12;
constexpr double kTop = 30;
constexpr double kBottom = 46;
constexpr double kMarkRadius = 3.6;
constexpr double kTickRoom = 6;    ///< between an axis and its numbers
constexpr double kHalfFont = 4.5;  ///< from the middle of a line of text to its base line

/// More labels than this crowd the horizontal axis.
constexpr int kMostStepLabels = 12;
/// More marks than this crowd a line: it is drawn without them.
constexpr std::size_t kMostMarks = 60;

constexpr int kDecimals = 2;

std::string Number(double value) { return FormatFixed(value, kDecimals); }

std::string Numbered(std::string_view name, double value) {
  return Attribute(name, Number(value)) + " ";
}

std::string Line(std::string_view style, double x1, double y1, double x2, double y2) {
  return Element("line",
                 Attribute("class", style) + " " + Numbered("x1", x1) + Numbered("y1", y1) +
                     Numbered("x2", x2) + Numbered("y2", y2),
                 "");
}

std::string Box(std::string_view style, double x, double y, double width, double height) {
  return Element("rect",
                 Attribute("class", style) + " " + Numbered("x", x) + Numbered("y", y) +
                     Numbered("width", width) + Numbered("height", height),
                 "");
}

/// @param anchor  "start", "middle" or "end".
std::string Text(std::string_view anchor, double x, double y, std::string_view text,
                 std::string_view more = "") {
  return Element("text",
                 Numbered("x", x) + Numbered("y", y) + Attribute("text-anchor", anchor) + " " +
                     std::string(more),
                 EscapeMarkup(text));
}

class Drawing {
 public:
  explicit Drawing(const StepPlot& plot)
      : plot_(plot), steps_(plot.series.front().values.size()), axis_(MakeAxis(plot)) {}

  [[nodiscard]] std::string Format() const {
    std::string svg = Element("title", "", EscapeMarkup(plot_.title));
    svg += Skipped() + Beyond() + VerticalAxis() + StepAxis() + Limit();
    for (std::size_t i = 0; i < plot_.series.size(); ++i) svg += Series(i);
    svg += Legend();
    return Element(
        "svg",
        "xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" " +
            Attribute("viewBox", "0 0 " + FormatShort(kWidth) + " " + FormatShort(kHeight)),
        svg);
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

  /// What follows the step that failed.
  [[nodiscard]] std::string Skipped() const {
    if (!plot_.failed || *plot_.failed + 1 >= static_cast<int>(steps_)) return "";
    const double from = X(*plot_.failed + 0.5);
    return Box("skipped", from, kTop, kWidth - kRight - from, kHeight - kBottom - kTop);
  }

  /// The bad side of the limit.
  [[nodiscard]] std::string Beyond() const {
    if (!plot_.limit) return "";
    const double y = Y(plot_.limit->value);
    const double from = plot_.limit->from_above ? kTop : y;
    const double to = plot_.limit->from_above ? y : kHeight - kBottom;
    return Box("beyond", kLeft, from, kWidth - kLeft - kRight, to - from);
  }

  [[nodiscard]] std::string VerticalAxis() const {
    std::string svg;
    for (const PlotTick& tick : axis_.ticks) {
      const double y = Y(tick.value);
      svg += Line("grid", kLeft, y, kWidth - kRight, y);
      svg += Text("end", kLeft - kTickRoom, y + kHalfFont, tick.label);
    }
    const double middle = (kTop + kHeight - kBottom) / 2;
    return svg + Text("middle", 0, 0, plot_.y_axis,
                      Attribute("transform", "translate(14 " + Number(middle) + ") rotate(-90)"));
  }

  [[nodiscard]] std::string StepAxis() const {
    const double base = kHeight - kBottom;
    std::string svg = Line("axis", kLeft, base, kWidth - kRight, base);
    const double least = static_cast<double>(steps_) / kMostStepLabels;
    const int stride = std::max(1, static_cast<int>(std::lround(RoundStep(least))));
    for (std::size_t step = 0; step < steps_; step += stride) {
      const double x = X(static_cast<double>(step));
      svg += Line("axis", x, base, x, base + kTickRoom / 2);
      svg += Text("middle", x, base + kTickRoom + 2.5 * kHalfFont, std::to_string(step));
    }
    return svg + Text("middle", (kLeft + kWidth - kRight) / 2, kHeight - kTickRoom, "step");
  }

  [[nodiscard]] std::string Limit() const {
    if (!plot_.limit) return "";
    const double y = Y(plot_.limit->value);
    // The label stands on the good side, where there is always room.
    const double text = plot_.limit->from_above ? y + 3 * kHalfFont : y - kHalfFont;
    const std::string line = Line("limit", kLeft, y, kWidth - kRight, y);
    if (plot_.limit->label.empty()) return line;
    return line + Text("end", kWidth - kRight - kTickRoom, text, plot_.limit->label,
                       Attribute("class", "limit"));
  }

  [[nodiscard]] std::string Series(std::size_t index) const {
    const PlotSeries& series = plot_.series[index];
    std::string points, path;
    bool drawing = false;
    for (std::size_t step = 0; step < steps_; ++step) {
      if (!series.values[step]) {
        drawing = false;
        continue;
      }
      const double x = X(static_cast<double>(step)), y = Y(*series.values[step]);
      path += (drawing ? "L" : "M") + Number(x) + " " + Number(y);
      drawing = true;
      if (steps_ <= kMostMarks || IsFailed(step)) points += Mark(series.mark, x, y, IsFailed(step));
    }
    return Element("g", Attribute("class", StyleOf(index)),
                   Element("path", Attribute("d", path), "") + points);
  }

  [[nodiscard]] bool IsFailed(std::size_t step) const {
    return plot_.failed && *plot_.failed == static_cast<int>(step);
  }

  static std::string StyleOf(std::size_t index) { return "series" + std::to_string(index); }

  static std::string Mark(PlotMark mark, double x, double y, bool failed) {
    std::string style = mark == PlotMark::kDisc ? "disc" : "ring";
    if (failed) style += " failed";
    return Element("circle",
                   Attribute("class", style) + " " + Numbered("cx", x) + Numbered("cy", y) +
                       Numbered("r", kMarkRadius),
                   "");
  }

  /// Names above the plot, each behind its mark; one text, so that names never overlap.
  [[nodiscard]] std::string Legend() const {
    constexpr double kBase = 16;
    std::string names;
    for (std::size_t i = 0; i < plot_.series.size(); ++i) {
      const PlotSeries& series = plot_.series[i];
      if (i > 0) names += "\u2003";
      names += Element("tspan", Attribute("class", StyleOf(i)),
                       series.mark == PlotMark::kDisc ? "●" : "○");
      names += "\u2009" + EscapeMarkup(series.name);
    }
    return Element("text", Numbered("x", kLeft) + Numbered("y", kBase), names);
  }

  const StepPlot& plot_;
  std::size_t steps_;
  PlotAxis axis_;
};

}  // namespace

std::string FormatStepPlot(const StepPlot& plot) {
  if (plot.series.empty() || plot.series.front().values.empty()) {
    throw std::invalid_argument("FormatStepPlot: nothing to plot");
  }
  for (const PlotSeries& series : plot.series) {
    if (series.values.size() != plot.series.front().values.size()) {
      throw std::invalid_argument("FormatStepPlot: series of different lengths");
    }
  }
  return Drawing(plot).Format();
}

}  // namespace regrasp
