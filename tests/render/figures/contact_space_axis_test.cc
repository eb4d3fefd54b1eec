#include <gmock/gmock.h>

#include "render/figures/contact_space_map.h"
#include "tests/render/figures/contact_space_scenes.h"
#include "tests/render/figures/planar_scenes.h"

namespace regrasp::render {
namespace contact_space_axis_test {

constexpr contour::RingIndex kOuter(0);

using testing::ElementsAre;
using testing::SizeIs;

std::vector<std::string> LabelsOf(const std::vector<AxisTick>& ticks) {
  std::vector<std::string> labels;
  for (const AxisTick& tick : ticks) {
    if (!tick.label.empty()) labels.push_back(tick.label);
  }
  return labels;
}

TEST(ContactSpaceAxisTest, FewVerticesHaveTheirLengths) {
  const object::Polygon square = MakeSquare();
  const std::vector<AxisTick> ticks = MakeTicks(contour::Boundary(square), kOuter, {0, 8}, 25, 28);
  EXPECT_THAT(LabelsOf(ticks), ElementsAre("0", "2", "4", "6", "8"));
  EXPECT_THAT(ticks, SizeIs(5));
}

TEST(ContactSpaceAxisTest, ManyVerticesHaveTicksAndRoundLengthsHaveLabels) {
  const object::Polygon disc = MakeDisc(60);
  const contour::Boundary boundary(disc);
  const double perimeter = boundary.perimeter(kOuter);  // 6.28
  const auto ticks = MakeTicks(boundary, kOuter, {0, perimeter}, 200 / perimeter, 28);
  EXPECT_THAT(LabelsOf(ticks), ElementsAre("0", "1", "2", "3", "4", "5", "6.28"));
  EXPECT_THAT(ticks, SizeIs(61 + 5));
}

TEST(ContactSpaceAxisTest, VerticesThatPrintDoesNotKeepApartAreThinned) {
  const object::Polygon disc = MakeDisc(300);
  const contour::Boundary boundary(disc);
  const double perimeter = boundary.perimeter(kOuter);
  const double points_per_unit = 200 / perimeter;
  double last = -1;
  int checked = 0;
  for (const AxisTick& tick :
       MakeTicks(boundary, kOuter, {0, perimeter}, points_per_unit, 1000)) {  // no round labels
    EXPECT_GE((tick.place - last) * points_per_unit, kTickGap * (1 - 1e-9));
    last = tick.place;
    ++checked;
  }
  EXPECT_GT(checked, 60);
  EXPECT_LT(checked, 200 / kTickGap + 1);
  EXPECT_NEAR(last, perimeter, 1e-9);
}

TEST(ContactSpaceAxisTest, BeyondTheEndTheRingBeginsAgain) {
  const object::Polygon square = MakeSquare();
  const auto ticks = MakeTicks(contour::Boundary(square), kOuter, {-3, 3}, 25, 28);
  EXPECT_THAT(LabelsOf(ticks), ElementsAre("6", "0", "2"));
  EXPECT_EQ(ticks.front().place, -2);
}

TEST(ContactSpaceAxisTest, LabelsKeepTheirDistanceAndDiffer) {
  const object::Polygon disc = MakeDisc(60);
  const contour::Boundary boundary(disc);
  const double perimeter = boundary.perimeter(kOuter);
  int checked = 0;
  for (const double width : {0.002, 0.03, 0.5, 1.0}) {
    for (const double from : {-0.3, 0.2, 0.9}) {
      const contour::PlaceRange shown = {from * perimeter, (from + width) * perimeter};
      const double points_per_unit = 300 / (width * perimeter);
      double last = -std::numeric_limits<double>::infinity();
      std::string last_label;
      for (const AxisTick& tick : MakeTicks(boundary, kOuter, shown, points_per_unit, 28)) {
        EXPECT_GE(tick.place, shown.low - 1e-8);
        EXPECT_LE(tick.place, shown.high + 1e-8);
        if (tick.label.empty()) continue;
        EXPECT_GE((tick.place - last) * points_per_unit, 28 * (1 - 1e-9)) << tick.label;
        EXPECT_NE(tick.label, last_label);
        last = tick.place;
        last_label = tick.label;
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 30);
}

TEST(ContactSpaceAxisTest, TitlesNameTheRingOfSeveralRings) {
  const object::Polygon square = MakeSquare();
  EXPECT_EQ(AxisTitle(contour::Boundary(square), "u", kOuter), "u");
  const object::Polygon ring = MakeRing(8);
  EXPECT_EQ(AxisTitle(contour::Boundary(ring), "u", kOuter), "u, outer ring");
  EXPECT_EQ(AxisTitle(contour::Boundary(ring), "u", contour::RingIndex(1)), "u, hole 1");
  EXPECT_EQ(AxisTitle(contour::Boundary(ring), "u", contour::RingIndex(1), {100, "cm"}),
            "u, hole 1 (cm)");
}

TEST(PlotWindowTest, PutsTheLowerLeftCornerBelow) {
  const PlotWindow window = {{1, 2}, {3, 6}, {10, 20}, {5, 4}};
  EXPECT_EQ(window.ToPage({1, 2}), Eigen::Vector2d(10, 36));
  EXPECT_EQ(window.ToPage({3, 6}), Eigen::Vector2d(20, 20));
  EXPECT_EQ(window.size(), Eigen::Vector2d(10, 16));
}

TEST(ContactSpaceAxisTest, TheUnitSuitsTheObjectAndTicksAreRoundInIt) {
  const object::Polygon square = MakeSquare();
  const contour::Boundary boundary(square);
  const auto labels = [&](double metres_per_unit, double gap) {
    const AxisUnit unit = UnitOfAxes(boundary, metres_per_unit);
    std::string text = unit.name + ":";
    for (const AxisTick& tick : MakeTicks(boundary, kOuter, {0, 8}, 25, gap, unit)) {
      if (!tick.label.empty()) text += " " + tick.label;
    }
    return text;
  };
  // Few vertices are labelled with their lengths.
  EXPECT_EQ(labels(1, 28), "m: 0 2 4 6 8");
  EXPECT_EQ(labels(0.01, 28), "cm: 0 2 4 6 8");
  EXPECT_EQ(labels(0.001, 28), "mm: 0 2 4 6 8");
  EXPECT_EQ(labels(0.0254, 28), "cm: 0 5.08 10.2 15.2 20.3");
  // If vertices are too close for labels, round lengths in the unit of the axis are labelled.
  EXPECT_EQ(labels(0.0254, 51), "cm: 0 10 20.3");
}

}  // namespace contact_space_axis_test
}  // namespace regrasp::render
