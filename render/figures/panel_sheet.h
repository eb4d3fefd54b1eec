#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <string>
#include <vector>

#include "planner/object/polygon.h"

namespace regrasp::render {

/// File formats of figures.
enum class FigureFormat { kSvg, kPdf, kPng };

/// Widths of figures in journals, points: one column (85 mm) and two (174 mm).
inline constexpr double kPointsPerMillimetre = 72 / 25.4;
inline constexpr double kColumnWidth = 85 * kPointsPerMillimetre;
inline constexpr double kTwoColumnWidth = 174 * kPointsPerMillimetre;

/// Program name in the metadata of a figure: creator of a PDF, software of a PNG, root node of a
/// glTF scene.
inline constexpr char kFigureMaker[] = "regrasp figure";

/// Write the program name into an SVG (as a comment after the first line) or a PNG (as a text chunk
/// after the header). Cairo writes it into a PDF.
/// @param bytes  complete file of the format.
void MarkFigure(FigureFormat format, std::string& bytes);

/// Return whether the bytes are those of a marked figure of any format.
[[nodiscard]] bool IsMarkedFigure(const std::string& bytes);

}  // namespace regrasp::render

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
  /// @param scale_bar  whether to draw the scale bar. All panels have one scale.
  virtual void Draw(cairo_t* cr, int index, double width, bool scale_bar = true) const = 0;

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
  std::string family = {};      ///< font family; empty for the default one
  bool captions = true;         ///< whether captions are below the panels
};

/// Return whether a font family is installed. The generic families (serif, sans-serif, monospace
/// and so on) always are.
[[nodiscard]] bool IsInstalledFamily(const std::string& family);

/// Draw a panel with its caption below.
/// @returns the bytes of the file.
/// @throws EnvironmentError  if Cairo fails.
[[nodiscard]] std::string DrawStepFigure(const FigurePanels& panels, int index,
                                         const FigureStyle& style);

/// Draw a sheet of panels in rows. Its last panel has the scale bar.
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

}  // namespace regrasp::render
