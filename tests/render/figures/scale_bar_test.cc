#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "render/figures/figure_page.h"
#include "render/figures/panel_sheet.h"
#include "render/figures/plan_figure.h"
#include "render/figures/planar_panel.h"
#include "render/picture/cairo_paint.h"
#include "tests/render/figures/planar_scenes.h"

namespace regrasp::render {
namespace scale_bar_test {

/// Pixels per point. Extents are whole pixels.
constexpr double kFine = 100;
/// Extent of the ticks beyond the ends of the bar, points.
constexpr double kSlack = 0.65;

/// Return the width of everything drawn below `top`, points.
double InkWidthBelow(double top, const std::function<void(cairo_t*)>& draw) {
  const CairoSurface surface(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, nullptr));
  const CairoContext context(cairo_create(surface.get()));
  cairo_scale(context.get(), kFine, kFine);
  cairo_rectangle(context.get(), -1000, top, 3000, 3000);
  cairo_clip(context.get());
  draw(context.get());
  double x = 0, y = 0, width = 0, height = 0;
  cairo_recording_surface_ink_extents(surface.get(), &x, &y, &width, &height);
  return width / kFine;
}

TEST(ScaleBar, IsARoundLengthOfAtMostAQuarterOfThePanel) {
  EXPECT_DOUBLE_EQ(ScaleBarLength(240, 1000), 0.05);
  EXPECT_DOUBLE_EQ(ScaleBarLength(240, 3000), 0.02);
  EXPECT_DOUBLE_EQ(ScaleBarLength(100, 25), 1);
}

TEST(ScaleBar, HasTheLengthOfItsLabel) {
  for (const double points_per_metre : {700.0, 1000.0, 1500.0}) {
    const double drawn = InkWidthBelow(-1000, [&](cairo_t* cr) {
      DrawScaleBar(cr, {240, 100}, points_per_metre);
    });
    const double labelled = ScaleBarLength(240, points_per_metre) * points_per_metre;
    EXPECT_NEAR(drawn, labelled, kSlack);
    // Negative control: a bar for another scale does not match.
    EXPECT_GT(
        std::abs(drawn - ScaleBarLength(240, 1.2 * points_per_metre) * points_per_metre / 1.2),
        kSlack);
  }
}

TEST(ScaleBar, OfAPlanarFigureFitsTheObjectBesideIt) {
  const object::Polygon square = Square(0.1);
  std::vector<StepDiagram> diagrams(1);
  const double width = 240;
  const PanelView view = FitView(square, diagrams, width);
  const double side = (view.ToPanel({0.1, 0}) - view.ToPanel({0, 0})).norm();
  for (const double metres_per_unit : {1.0, 0.001, 0.0254}) {
    const PlanPanels panels(square, diagrams, metres_per_unit);
    EXPECT_DOUBLE_EQ(panels.HeightFor(width), view.height + kScaleBarSpace);
    const double bar = InkWidthBelow(view.height, [&](cairo_t* cr) { panels.Draw(cr, 0, width); });
    const double points_per_metre = side / (0.1 * metres_per_unit);
    EXPECT_NEAR(bar, ScaleBarLength(width, points_per_metre) * points_per_metre, kSlack);
    EXPECT_GT(bar, 0.09 * width);
  }
}

}  // namespace scale_bar_test
}  // namespace regrasp::render
