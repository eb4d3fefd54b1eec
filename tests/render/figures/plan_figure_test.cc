#include "render/figures/plan_figure.h"

#include <gmock/gmock.h>
#include <png.h>

#include <cmath>
#include <iterator>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "render/figures/figure_page.h"
#include "render/figures/panel_sheet.h"
#include "render/figures/planar_panel.h"
#include "render/picture/image.h"
#include "tests/render/figures/planar_scenes.h"

namespace regrasp::render {
namespace plan_figure_test {

using Eigen::Vector2d;
using testing::ElementsAre;
using testing::SizeIs;

constexpr FigureFormat kFormats[] = {FigureFormat::kSvg, FigureFormat::kPdf, FigureFormat::kPng};

std::vector<StepDiagram> SquareDiagrams() { return DescribePlan(MakeSquare(), MakeSquarePlan()); }

PlanPanels SquarePanels() {
  static const object::Polygon square = MakeSquare();
  return {square, SquareDiagrams()};
}

std::string Step(int index, FigureFormat format) {
  return DrawStepFigure(SquarePanels(), index, {.format = format});
}

int Count(const std::string& text, const std::regex& pattern) {
  return static_cast<int>(
      std::distance(std::sregex_iterator(text.begin(), text.end(), pattern), {}));
}

/// Count the opaque paths of an SVG in a finger's colour, such as markers and arrow heads.
int OpaqueFills(const std::string& svg, int finger) {
  const Color color = FingerColor(FingerIndex(finger));
  const auto percent = [](int channel) { return std::to_string(channel * 100 / 255); };
  const std::string channel = "(\\.\\d+)?%,\\s*";
  const std::string rgb = "rgb\\(" + percent(color.r) + channel + percent(color.g) + channel +
                          percent(color.b) + "(\\.\\d+)?%\\)";
  return Count(svg, std::regex("fill:\\s*" + rgb + ";fill-opacity:1;"));
}

struct Size {
  int width = 0;
  int height = 0;
};

Size PngSize(const std::string& bytes) {
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0) return {};
  const Size size = {static_cast<int>(header.width), static_cast<int>(header.height)};
  png_image_free(&header);
  return size;
}

TEST(PlanFigureTest, EachFormatBeginsAsItsFilesDo) {
  EXPECT_EQ(Step(0, FigureFormat::kSvg).substr(0, 5), "<?xml");
  EXPECT_EQ(Step(0, FigureFormat::kPdf).substr(0, 5), "%PDF-");
  EXPECT_EQ(Step(0, FigureFormat::kPng).substr(0, 4), "\x89PNG");
}

TEST(PlanFigureTest, TheSameFigureHasTheSameBytesAndAnotherHasOthers) {
  // Files are compared as a whole: EXPECT_EQ would print megabytes.
  for (const FigureFormat format : kFormats) {
    EXPECT_TRUE(Step(1, format) == Step(1, format));
    EXPECT_FALSE(Step(1, format) == Step(2, format));
    EXPECT_TRUE(DrawSheet(SquarePanels(), {.format = format}) ==
                DrawSheet(SquarePanels(), {.format = format}));
  }
}

TEST(PlanFigureTest, EveryFingerInContactHasAMarkerInItsColour) {
  const std::string hold = Step(0, FigureFormat::kSvg);
  for (const int finger : {0, 1, 2}) EXPECT_EQ(OpaqueFills(hold, finger), 1) << finger;
  EXPECT_EQ(OpaqueFills(hold, 3), 0);
  const std::string two = Step(3, FigureFormat::kSvg);
  EXPECT_EQ(OpaqueFills(two, 3), 1);
  EXPECT_EQ(OpaqueFills(two, 0), 2);  // with the head of the arrow towards the contact
  EXPECT_EQ(OpaqueFills(two, 1),
            1);  // only the head of the arrow away from the contact, because the marker is hollow
}

TEST(PlanFigureTest, AStepIsAColumnWideAndASheetTwo) {
  // 300 dots per inch: 85 mm and 174 mm.
  EXPECT_EQ(PngSize(Step(0, FigureFormat::kPng)).width, 1004);
  EXPECT_EQ(PngSize(DrawSheet(SquarePanels(), {.format = FigureFormat::kPng})).width, 2055);
}

TEST(PlanFigureTest, ALongPlanMakesALargerSheetThatCanBeDrawn) {
  const object::Polygon square = MakeSquare();
  const StepDiagram hold = SquareDiagrams()[0];
  const std::vector<StepDiagram> many(150, hold);
  const Size size = PngSize(DrawSheet(PlanPanels(square, many), {.format = FigureFormat::kPng}));
  EXPECT_GT(size.width, 2055);
  EXPECT_GT(size.height, 2055);
}

TEST(PlanFigureTest, ALongObjectHasFewerPanelsInARow) {
  const auto height = [](const object::Polygon& polygon) {
    StepDiagram hold = SquareDiagrams()[0];
    hold.grasp = {};
    hold.fingers.clear();
    const std::vector<StepDiagram> four(4, hold);
    return PngSize(DrawSheet(PlanPanels(polygon, four), {.format = FigureFormat::kPng})).height;
  };
  const object::Polygon bar =
      object::Polygon::FromRings({{{-1, -0.1}, {1, -0.1}, {1, 0.1}, {-1, 0.1}}}, "bar");
  const object::Polygon plate =
      object::Polygon::FromRings({{{-1, -0.5}, {1, -0.5}, {1, 0.5}, {-1, 0.5}}}, "plate");
  // Two rows of bars are higher than one row of plates, although a plate is five times as high.
  EXPECT_GT(height(bar), height(plate));
}

TEST(PlanFigureTest, RowsOfASheetAreFilled) {
  for (const auto& [count, columns] :
       {std::pair{1, 1}, {2, 2}, {3, 3}, {4, 4}, {5, 3}, {6, 3}, {7, 4}, {8, 4}, {24, 4}}) {
    EXPECT_EQ(SheetColumns(count), columns) << count;
  }
  EXPECT_EQ(SheetColumns(10000), 100);
}

TEST(PanelViewTest, ShowsThePolygonAndAllFocusPointsThatAreNear) {
  const object::Polygon triangle = MakeTriangle();
  std::vector<StepDiagram> diagrams = DescribePlan(triangle, MakeTrianglePlan());
  const auto shows = [&](const PanelView& view, const Vector2d& p) {
    const Vector2d at = view.ToPanel(p);
    return at.x() >= 0 && at.y() >= 0 && at.x() <= view.width && at.y() <= view.height;
  };
  const PanelView view = FitView(triangle, diagrams, 200);
  for (const Vector2d& p : triangle.rings().front()) EXPECT_TRUE(shows(view, p));
  const Vector2d below(0.5, -0.3);
  EXPECT_FALSE(shows(view, below));
  diagrams[1].grasp.focus = below;
  EXPECT_TRUE(shows(FitView(triangle, diagrams, 200), below));
  diagrams[1].grasp.focus = Vector2d(0.5, -30);
  EXPECT_EQ(FitView(triangle, diagrams, 200).scale, view.scale);
}

TEST(PanelViewTest, ATallObjectIsNoTallerThanAPage) {
  const object::Polygon tower =
      object::Polygon::FromRings({{{0, 0}, {1, 0}, {1, 50}, {0, 50}}}, "tower");
  const PanelView view = FitView(tower, {}, 200);
  EXPECT_NEAR(view.height, 200 * kTallestPanel, 1e-9);
  EXPECT_NEAR(view.ToPanel({0, 50}).y(), kPanelMargin, 1e-9);
  EXPECT_NEAR(view.ToPanel({0.5, 0}).x(), 100, 1e-9);
}

TEST(PanelGraspTest, AConeReachesBeyondTheFocusOnItsSideOnly) {
  const object::Polygon triangle = MakeTriangle();
  const StepDiagram diagram = DescribePlan(triangle, MakeTrianglePlan())[0];
  const PanelView view = FitView(triangle, {}, 240);
  ASSERT_FALSE(diagram.grasp.cones.empty());
  for (const DoubleCone& cone : diagram.grasp.cones) {
    const double distance = view.scale * (*diagram.grasp.focus - cone.apex).norm();
    EXPECT_GT(ConeLength(triangle, diagram.grasp, cone, 1, view), distance);
    EXPECT_LT(ConeLength(triangle, diagram.grasp, cone, -1, view), kPanelMargin);
  }
}

TEST(PanelGraspTest, AConeEndsOnThePanel) {
  const object::Polygon square = MakeSquare();
  const PanelView view = FitView(square, {}, 240);
  const auto length = [&](double x) {
    // The material is on the right side, like at the border of a hole.
    const DoubleCone cone = {Vector2d(x, 0), Vector2d(1, 0), 0.3};
    return ConeLength(square, {}, cone, 1, view);
  };
  EXPECT_EQ(length(-0.5), length(0));
  EXPECT_LT(length(0.8), length(0));
  EXPECT_LT(view.ToPanel({0.8, 0}).x() + length(0.8), 240);
}

TEST(PanelFingersTest, OutwardClearanceEndsAtThePolygon) {
  const object::Polygon frame = object::Polygon::FromRings(
      {{{0, 0}, {6, 0}, {6, 6}, {0, 6}}, {{1, 1}, {1, 4}, {4, 4}, {4, 1}}}, "frame");
  EXPECT_NEAR(OutwardClearance(frame, {Vector2d(1, 2), Vector2d(1, 0)}), 3, 1e-12);
  EXPECT_TRUE(std::isinf(OutwardClearance(frame, {Vector2d(6, 2), Vector2d(1, 0)})));
}

TEST(PanelTextTest, ACaptionBreaksAfterClausesOrBetweenWords) {
  const std::string caption = "(a) hold: fingers 0, 1; concurrent grasp";
  EXPECT_THAT(WrapCaption(caption, 500), ElementsAre(caption));
  EXPECT_THAT(WrapCaption(caption, 100),
              ElementsAre("(a) hold: fingers 0, 1;", "concurrent grasp"));
  EXPECT_THAT(WrapCaption("(c) switch: place 3, release 0, 2; 2-finger grasp", 115),
              ElementsAre("(c) switch: place 3,", "release 0, 2; 2-finger grasp"));
  EXPECT_THAT(WrapCaption(caption, 1), SizeIs(5));
  EXPECT_THAT(WrapCaption("", 100), SizeIs(0));
}

TEST(PlanFigureTest, AFigureHasTheRequestedWidthAndFontSize) {
  const auto width = [](const FigureStyle& style) {
    return PngSize(DrawStepFigure(SquarePanels(), 0, style)).width;
  };
  constexpr double kDotsPerMillimetre = 300 / 25.4;
  for (const double millimetres : {60.0, 120.0}) {
    for (const double points : {6.0, 9.0}) {
      EXPECT_NEAR(width({.format = FigureFormat::kPng, .width_mm = millimetres, .font_pt = points}),
                  millimetres * kDotsPerMillimetre, 1);
    }
  }
  // Larger text in the same width requires another layout. Scaling alone is not enough.
  const auto svg = [](double points) {
    return DrawStepFigure(SquarePanels(), 0, {.format = FigureFormat::kSvg, .font_pt = points});
  };
  EXPECT_NE(svg(7.5), svg(9));
}

TEST(PlanFigureTest, ASheetHasTheChosenPanelsInOrder) {
  const FigureStyle png = {.format = FigureFormat::kPng};
  const PlanPanels panels = SquarePanels();
  const int all = panels.count();
  ASSERT_GT(all, 2);
  const std::vector<int> one = {1}, two = {1, 0}, turned = {0, 1};
  EXPECT_LT(PngSize(DrawSheet(panels, one, png)).width, PngSize(DrawSheet(panels, two, png)).width);
  EXPECT_NE(DrawSheet(panels, two, png), DrawSheet(panels, turned, png));
  std::vector<int> every;
  for (int i = 0; i < all; ++i) every.push_back(i);
  EXPECT_EQ(DrawSheet(panels, every, png), DrawSheet(panels, png));
}

}  // namespace plan_figure_test
}  // namespace regrasp::render
