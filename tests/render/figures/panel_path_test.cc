#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "render/figures/panel_sheet.h"
#include "render/figures/planar_panel.h"
#include "tests/render/figures/planar_scenes.h"

namespace regrasp::render {
namespace panel_path_test {

using Eigen::Vector2d;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kDistance = 4;

/// Return a view with one point per unit: the panel has the lengths of the polygon, upside down.
PanelView UnitView() { return {.width = 100, .height = 100}; }

TEST(PanelPathTest, GoesAroundAVertexThroughTheMiddleOfItsNormals) {
  const double half = std::numbers::sqrt2 / 2;
  const std::vector<BorderPoint> path = {
      {{0, 20}, {0, 1}}, {{20, 20}, {0, 1}}, {{20, 20}, {1, 0}}, {{20, 0}, {1, 0}}};
  const PanelView view = UnitView();
  const PanelPath beside = PathBeside(path, view, kDistance);
  ASSERT_THAT(beside.points, SizeIs(3));
  const Vector2d corner = view.ToPanel({20 + kDistance * half, 20 + kDistance * half});
  EXPECT_LT((beside.points[1] - corner).norm(), 1e-12);
  ASSERT_THAT(beside.ticks, SizeIs(1));
  EXPECT_LT((beside.ticks[0].across - Vector2d(half, -half)).norm(), 1e-12);
}

/// Return a path across a notch with vertical sides, `width` wide and 20 deep.
std::vector<BorderPoint> AcrossNotch(double width) {
  return {{{-30, 0}, {0, 1}},       {{0, 0}, {0, 1}},      {{0, 0}, {1, 0}},
          {{0, -20}, {1, 0}},       {{0, -20}, {0, 1}},    {{width, -20}, {0, 1}},
          {{width, -20}, {-1, 0}},  {{width, 0}, {-1, 0}}, {{width, 0}, {0, 1}},
          {{width + 30, 0}, {0, 1}}};
}

TEST(PanelPathTest, OmitsBackwardPartsInANarrowNotch) {
  const PanelView view = UnitView();
  const PanelPath wide = PathBeside(AcrossNotch(20), view, kDistance);
  EXPECT_THAT(wide.points, SizeIs(6));
  EXPECT_GT(wide.points[3].x(), wide.points[2].x());  // along the floor
  const PanelPath narrow = PathBeside(AcrossNotch(3), view, kDistance);
  EXPECT_THAT(narrow.points, SizeIs(5));  // the floor is one point
  EXPECT_GT(narrow.points[2].y(), narrow.points[1].y());
  EXPECT_GT(narrow.points[2].y(), narrow.points[3].y());
  EXPECT_EQ(narrow.points.front(), wide.points.front());
}

TEST(PanelPathTest, TicksKeepApartHoweverManyWaypointsThereAre) {
  std::vector<BorderPoint> path;
  for (int k = 0; k <= 50; ++k) path.push_back({{2.0 * k, 0}, {0, 1}});
  const PanelPath beside = PathBeside(path, UnitView(), kDistance);
  EXPECT_THAT(beside.points, SizeIs(51));
  ASSERT_THAT(beside.ticks, SizeIs(15));
  for (std::size_t i = 1; i < beside.ticks.size(); ++i) {
    EXPECT_GE((beside.ticks[i].at - beside.ticks[i - 1].at).norm(), kPathTickGap);
  }
  EXPECT_GE((beside.ticks.back().at - beside.points.back()).norm(), kPathTickGap);
  EXPECT_THAT(PathBeside(std::span(path).first(3), UnitView(), kDistance).ticks, IsEmpty());
}

}  // namespace panel_path_test
}  // namespace regrasp::render
