#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <string>
#include <vector>

#include "planner/base/index.h"
#include "planner/object/polygon.h"
#include "render/figures/figure_page.h"
#include "render/picture/image.h"

/// Forward declaration of Cairo's type, so that users of panels do not include Cairo.
using cairo_t = struct _cairo;

namespace regrasp::render {

/// The panels of a figure for a paper: images of one size and scale, each with a caption.
class FigurePanels {
 public:
  virtual ~FigurePanels() = default;

  [[nodiscard]] virtual int count() const = 0;
  /// Return the caption of a panel, for example "(a) hold: fingers 0, 1, 2".
  [[nodiscard]] virtual std::string caption(int index) const = 0;
  /// Return the height of a panel for a width, points.
  [[nodiscard]] virtual double HeightFor(double width) const = 0;
  /// Draw a panel from (0, 0) to (width, HeightFor(width)), with clipping.
  virtual void Draw(cairo_t* cr, int index, double width) const = 0;

 protected:
  FigurePanels() = default;
  FigurePanels(const FigurePanels&) = default;
  FigurePanels& operator=(const FigurePanels&) = default;
};

/// Print settings of a figure. Markers, lines and arrows scale with the font size.
struct FigureStyle {
  FigureFormat format = FigureFormat::kSvg;
  double width_mm = 85;         ///< width of the figure of one step: a column of a journal
  double sheet_width_mm = 174;  ///< width of a sheet: two columns
  double font_pt = 7.5;         ///< font size of captions and numbers
};

/// Draw a panel with its caption below.
/// @returns the bytes of the file.
/// @throws EnvironmentError  if Cairo fails.
[[nodiscard]] std::string DrawStepFigure(const FigurePanels& panels, int index,
                                         const FigureStyle& style);

/// Draw a sheet of panels in rows.
///
/// Sheets of low panels have fewer columns. More than 24 panels make the sheet wider instead of
/// reducing panels.
/// @param indices  panels in the order of the sheet.
/// @returns the bytes of the file.
/// @throws EnvironmentError  if Cairo fails.
[[nodiscard]] std::string DrawSheet(const FigurePanels& panels, std::span<const int> indices,
                                    const FigureStyle& style);
/// Draw a sheet of all panels.
[[nodiscard]] std::string DrawSheet(const FigurePanels& panels, const FigureStyle& style);

/// Return the number of columns of a sheet with `count` (> 0) panels that are not low.
[[nodiscard]] int SheetColumns(int count);

enum class MarkerStyle {
  kFilled,
  kPale,    ///< contact behind the object
  kHollow,  ///< white with a border: position that a finger has left
};

/// Radius of a marker without other markers on top, points.
inline constexpr double kMarkerRadius = 2.7;

/// A marker for the position of a finger. Shapes (disc, square, triangle, diamond, pentagon) and
/// colours differ between fingers, and repeat after five. Markers are therefore distinguishable in
/// greyscale.
struct FingerMarker {
  FingerIndex finger = {};
  Eigen::Vector2d centre;  ///< position, points
  MarkerStyle style = MarkerStyle::kFilled;
  bool ring = false;              ///< whether it has the ring of a placed finger
  double radius = kMarkerRadius;  ///< radius of the disc with the same area, points

  /// Return the distance from the centre to the outer border, with the ring, points.
  [[nodiscard]] double reach() const;
};

/// Enlarge markers that others cover by more than half, so that a rim stays visible. Contacts at
/// one position are drawn nested.
/// @param markers  markers in drawing order.
void EnlargeCovered(std::span<FingerMarker> markers);

void DrawFingerMarker(cairo_t* cr, const FingerMarker& marker);

/// Mix a colour with white.
/// @param share  share of the colour, 0 to 1.
[[nodiscard]] Color Paler(Color color, double share);

/// Share of the colour of elements behind an object.
inline constexpr double kBehindShare = 0.45;

}  // namespace regrasp::render
