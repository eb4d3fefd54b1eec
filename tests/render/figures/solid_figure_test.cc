#include "render/figures/solid_figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "planner/base/number.h"
#include "planner/plan/projection.h"
#include "render/figures/panel_sheet.h"
#include "render/figures/planar_panel.h"
#include "tests/fixtures/solids.h"

namespace regrasp::render {
namespace solid_figure_test {

using Eigen::Vector3d;
using testing::HasSubstr;
using testing::Not;

plan::FingerContact Hold(int finger, const Vector3d& p, const Vector3d& n) {
  return {FingerIndex(finger), {p, n}};
}

/// Return a plan that replaces one of four fingers on a cube of 6 cm.
plan::Plan MakePlan(const object::Polyhedron& cube) {
  plan::Plan plan;
  plan.dimension = 3;
  plan.friction_angle = Radians(20);
  plan.initial = {Hold(0, {0.03, 0, 0.01}, {-1, 0, 0}), Hold(1, {-0.03, 0, 0.01}, {1, 0, 0}),
                  Hold(2, {0, 0.03, 0}, {0, -1, 0}), Hold(3, {0, -0.03, 0}, {0, 1, 0})};
  plan::Switch change;
  change.place = {Hold(4, {0.01, 0.03, 0.01}, {0, -1, 0})};
  change.release = {FingerIndex(2)};
  plan.steps = {change};
  return plan::ProjectPlan(cube, plan);
}

SolidPanels MakePanels(const SolidFigureOptions& options = {}) {
  static const object::Polyhedron cube = MakeCube(0.03);
  return {cube, MakePlan(cube), options};
}

int Count(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  return static_cast<int>(std::distance(std::sregex_iterator(text.begin(), text.end(), regex), {}));
}

TEST(SolidFigureTest, HasAPanelForEachStepWithItsCaption) {
  const SolidPanels panels = MakePanels();
  ASSERT_EQ(panels.count(), 2);
  EXPECT_EQ(panels.caption(0), "(a) hold: fingers 0, 1, 2, 3");
  EXPECT_EQ(panels.caption(1), "(b) switch: place 4, release 2");
}

TEST(SolidFigureTest, TheSameFigureHasTheSameBytesAndAnotherViewHasOthers) {
  const std::string once = DrawSheet(MakePanels(), {.format = FigureFormat::kSvg});
  EXPECT_EQ(once, DrawSheet(MakePanels(), {.format = FigureFormat::kSvg}));
  EXPECT_NE(once,
            DrawSheet(MakePanels({.view = ViewDirection{1, 0.2}}), {.format = FigureFormat::kSvg}));
}

TEST(SolidFigureTest, HiddenEdgesAreDashed) {
  const SolidFigureOptions view = {.view = ViewDirection{Radians(30), Radians(25)}};
  SolidFigureOptions no_edges = view;
  no_edges.body.edges = EdgeStyle::kNone;
  const auto dashed = [](const SolidFigureOptions& options) {
    return Count(DrawStepFigure(MakePanels(options), 0, {.format = FigureFormat::kSvg}),
                 "stroke-dasharray");
  };
  EXPECT_EQ(dashed(view), 3);  // the edges at the hidden corner
  EXPECT_EQ(dashed(no_edges), 0);
}

/// Return a sphere with a rough surface, like a scan.
object::Polyhedron MakeScan() {
  constexpr int kRings = 12, kSides = 24;
  object::PolygonSoup soup;
  const auto radius = [](int i, int j) { return 0.03 * (1 + 0.01 * ((7 * i + 5 * j) % 3)); };
  soup.vertices = {{0, 0, -0.03}, {0, 0, 0.03}};
  for (int i = 1; i < kRings; ++i) {
    for (int j = 0; j < kSides; ++j) {
      const double tilt = M_PI * i / kRings, turn = 2 * M_PI * j / kSides;
      soup.vertices.push_back(radius(i, j) * Vector3d(std::sin(tilt) * std::cos(turn),
                                                      std::sin(tilt) * std::sin(turn),
                                                      -std::cos(tilt)));
    }
  }
  const auto at = [](int i, int j) { return 2 + (i - 1) * kSides + j % kSides; };
  for (int j = 0; j < kSides; ++j) {
    soup.facets.push_back({0, at(1, j + 1), at(1, j)});
    soup.facets.push_back({1, at(kRings - 1, j), at(kRings - 1, j + 1)});
    for (int i = 1; i + 1 < kRings; ++i) {
      soup.facets.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      soup.facets.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  return object::Polyhedron::FromSoup(soup, "scan");
}

TEST(SolidFigureTest, AScanHasOneAreaAndNoDashedLines) {
  const object::Polyhedron scan = MakeScan();
  plan::Plan plan;
  plan.dimension = 3;
  plan.friction_angle = Radians(20);
  plan.initial = {Hold(0, {0.03, 0, 0}, {-1, 0, 0})};
  const std::string svg = DrawStepFigure(SolidPanels(scan, plan::ProjectPlan(scan, plan), {}), 0,
                                         {.format = FigureFormat::kSvg});
  EXPECT_EQ(Count(svg, "stroke-dasharray"), 0);
  // The area, its outline, the marks of one finger and letters. There are 528 triangles.
  EXPECT_LT(Count(svg, "<path"), 60);
  EXPECT_LT(svg.size(), 40'000U);
}

TEST(SolidFigureTest, AFingerBehindTheSolidIsPaleAndOneBeforeItIsNot) {
  // Finger 0 is on the +x side, finger 1 on the −x side.
  const auto draw = [](double azimuth) {
    const SolidFigureOptions options = {.view = ViewDirection{Radians(azimuth), Radians(20)}};
    return DrawStepFigure(MakePanels(options), 0, {.format = FigureFormat::kSvg});
  };
  // Filled markers in the finger's own colour. A stem, which is visible too, is stroked.
  const std::string blue = "fill:rgb\\(0%,39.607843%,64.705882%\\);fill-opacity:1";
  const std::string yellow = "fill:rgb\\(94.117647%,69.019608%,0%\\);fill-opacity:1";
  const auto plain = [](std::string svg) {
    std::erase(svg, ' ');
    return svg;
  };
  EXPECT_EQ(Count(plain(draw(20)), blue), 1);
  EXPECT_EQ(Count(plain(draw(20)), yellow), 0);
  EXPECT_EQ(Count(plain(draw(200)), blue), 0);
  EXPECT_EQ(Count(plain(draw(200)), yellow), 1);
}

TEST(SolidFigureTest, APanelIsAsHighAsItNeedsAndNoHigher) {
  const auto height = [](const Vector3d& size) {
    const object::Polyhedron box = MakeBox(size);
    plan::Plan plan;
    plan.dimension = 3;
    plan.friction_angle = Radians(20);
    plan.initial = {Hold(0, {size.x() / 2, 0, 0}, {-1, 0, 0})};
    const SolidFigureOptions view = {.view = ViewDirection{Radians(270), 0}};
    return SolidPanels(box, plan::ProjectPlan(box, plan), view).HeightFor(200);
  };
  EXPECT_LT(height({1, 0.1, 0.1}), height({1, 0.1, 0.5}));
  EXPECT_DOUBLE_EQ(height({0.1, 0.1, 3}), 1.25 * 200);
}

}  // namespace solid_figure_test
}  // namespace regrasp::render
