#include "report/page/step_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <regex>
#include <stdexcept>
#include <string>

namespace regrasp::report {
namespace step_plot_test {

using testing::HasSubstr;
using testing::Not;

int Count(const std::string& text, const std::string& part) {
  int count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

std::string FormatStepPlot(const StepPlot& plot) { return DrawStepPlot(plot).Format(); }

StepPlot MakePlot() {
  StepPlot plot;
  plot.title = "Motion <over> the steps";
  plot.y_axis = "metres";
  plot.logarithmic = true;
  plot.series = {{"moved", {1e-9, 3e-8, 2e-6}, PlotMark::kDisc},
                 {"slipped", {1e-8, std::nullopt, 0.0}, PlotMark::kRing}};
  plot.limit = PlotLimit{6e-5, "tolerance 60 µm", true};
  return plot;
}

TEST(StepPlotTest, EveryValueHasAMarkAndNoneWhereThereIsNoValue) {
  const std::string svg = FormatStepPlot(MakePlot());
  EXPECT_EQ(Count(svg, "class=\"disc\""), 3);
  EXPECT_EQ(Count(svg, "class=\"ring\""), 2);
  EXPECT_EQ(Count(svg, "<tspan"), 2);
  EXPECT_THAT(svg, Not(HasSubstr("failed")));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(StepPlotTest, TicksOfLengthsHaveAUnit) {
  const std::string svg = FormatStepPlot(MakePlot());
  for (const char* length : {">1 nm<", ">1 µm<", ">100 µm<"}) EXPECT_THAT(svg, HasSubstr(length));
  EXPECT_THAT(svg, Not(HasSubstr("10⁻")));
}

TEST(StepPlotTest, TextsAreEscapedAndTheLimitIsNamed) {
  const std::string svg = FormatStepPlot(MakePlot());
  EXPECT_THAT(svg, HasSubstr("Motion &lt;over&gt; the steps"));
  EXPECT_THAT(svg, HasSubstr("tolerance 60 µm"));
  EXPECT_EQ(Count(svg, "class=\"limit\""), 2);
  StepPlot plot = MakePlot();
  plot.limit.reset();
  EXPECT_EQ(Count(FormatStepPlot(plot), "limit"), 0);
}

/// Return by how much the name of the limit is below its line.
double HeightBelowLimit(const StepPlot& plot) {
  const std::string svg = FormatStepPlot(plot);
  const auto height_of = [&svg](const std::string& element, const std::string& name) {
    std::smatch tag, value;
    const std::regex wanted("<" + element + "[^>]*class=\"limit\"[^>]*>");
    if (!std::regex_search(svg, tag, wanted)) throw std::runtime_error("no limit");
    const std::string text = tag.str();
    if (!std::regex_search(text, value, std::regex(" " + name + "=\"([0-9.]+)\"")))
      throw std::runtime_error("no height");
    return std::stod(value[1]);
  };
  return height_of("text", "y") - height_of("line", "y1");
}

TEST(StepPlotTest, TheNameOfALimitDoesNotCoverTheAxis) {
  StepPlot plot = MakePlot();
  EXPECT_GT(HeightBelowLimit(plot), 0) << "on the good side";
  plot.series = {{"moved", {2e-3, 8e-4, 1e-2}, PlotMark::kDisc}};
  plot.limit->value = 1e-4;  // at the end of the axis
  EXPECT_LT(HeightBelowLimit(plot), 0);
}

TEST(StepPlotTest, AFailedStepIsMarkedAndWhatFollowsIsShaded) {
  StepPlot plot = MakePlot();
  plot.failed = 0;
  const std::string svg = FormatStepPlot(plot);
  EXPECT_EQ(Count(svg, "failed"), 2);
  EXPECT_EQ(Count(svg, "class=\"skipped\""), 1);
  plot.failed = 2;
  EXPECT_EQ(Count(FormatStepPlot(plot), "class=\"skipped\""), 0);
}

TEST(StepPlotTest, LargerValuesLieHigher) {
  StepPlot plot;
  plot.series = {{"x", {1.0, 2.0}, PlotMark::kDisc}};
  const std::string svg = FormatStepPlot(plot);
  const auto first = svg.find("d=\"M");
  ASSERT_NE(first, std::string::npos);
  double x1 = 0, y1 = 0, x2 = 0, y2 = 0;
  ASSERT_EQ(std::sscanf(svg.c_str() + first, "d=\"M%lf %lfL%lf %lf", &x1, &y1, &x2, &y2), 4);
  EXPECT_LT(x1, x2);
  EXPECT_GT(y1, y2);
}

TEST(StepPlotTest, ManyStepsAreDrawnAsALineWithFewLabels) {
  StepPlot plot;
  plot.series = {{"x", std::vector<std::optional<double>>(1000, 1.0), PlotMark::kDisc}};
  plot.failed = 700;
  const std::string svg = FormatStepPlot(plot);
  EXPECT_EQ(Count(svg, "<circle"), 1);
  EXPECT_LE(Count(svg, "<text"), 25);
}

TEST(StepPlotTest, WhatCannotBePlottedIsRefused) {
  EXPECT_THROW(static_cast<void>(FormatStepPlot({})), std::invalid_argument);
  StepPlot plot = MakePlot();
  plot.series[1].values.pop_back();
  EXPECT_THROW(static_cast<void>(FormatStepPlot(plot)), std::invalid_argument);
  plot = MakePlot();
  plot.series[0].values[1] = std::nan("");
  EXPECT_THROW(static_cast<void>(FormatStepPlot(plot)), std::invalid_argument);
}

}  // namespace step_plot_test
}  // namespace regrasp::report
