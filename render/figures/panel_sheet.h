#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <string>
#include <vector>

#include "planner/object/polygon.h"
#include "render/figures/figure_format.h"

/// Cairo's, so that who names panels needs no Cairo.
using cairo_t = struct _cairo;

namespace regrasp::render {

/// The panels of a figure for a paper: pictures of one size and scale, each with a caption.
class FigurePanels {
 public:
  virtual ~FigurePanels() = default;

  [[nodiscard]] virtual int count() const = 0;
  /// "(a) hold: fingers 0, 1, 2".
  [[nodiscard]] virtual std::string caption(int index) const = 0;
  /// How high a panel is that is `width` wide, points.
  [[nodiscard]] virtual double HeightFor(double width) const = 0;
  /// Draws a panel from (0, 0) to (width, HeightFor(width)); what is beyond is clipped.
  virtual void Draw(cairo_t* cr, int index, double width) const = 0;

 protected:
  FigurePanels() = default;
  FigurePanels(const FigurePanels&) = default;
  FigurePanels& operator=(const FigurePanels&) = default;
};

/// How a figure is printed. Markers, lines and arrows are as large beside the text as they are by
/// default.
struct FigureStyle {
  FigureFormat format = FigureFormat::kSvg;
  double width_mm = 85;         ///< of the figure of one step: a column of a journal
  double sheet_width_mm = 174;  ///< two columns
  double font_pt = 7.5;         ///< of captions and numbers
};

/// A panel with its caption below, as a file's bytes.
/// @throws EnvironmentError  Cairo failed.
[[nodiscard]] std::string DrawStepFigure(const FigurePanels& panels, int index,
                                         const FigureStyle& style);

/// A sheet of panels in rows, in the order of `indices`. Low panels stand fewer in a row; more than
/// 24 make the sheet wider, not the panels smaller.
/// @throws EnvironmentError  Cairo failed.
[[nodiscard]] std::string DrawSheet(const FigurePanels& panels, std::span<const int> indices,
                                    const FigureStyle& style);
/// Of all panels.
[[nodiscard]] std::string DrawSheet(const FigurePanels& panels, const FigureStyle& style);

/// Panels in a row of a sheet of `count` (> 0), where they are not low.
[[nodiscard]] int SheetColumns(int count);

}  // namespace regrasp::render
