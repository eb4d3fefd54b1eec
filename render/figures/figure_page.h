#pragma once

#include <cairo.h>

#include <memory>
#include <string>

#include "render/picture/cairo_paint.h"

namespace regrasp::render {

/// The file formats of figures.
enum class FigureFormat { kSvg, kPdf, kPng };

/// The widths that journals print figures at, in points: a column, 85 mm, and two, 174 mm.
inline constexpr double kPointsPerMillimetre = 72 / 25.4;
inline constexpr double kColumnWidth = 85 * kPointsPerMillimetre;
inline constexpr double kTwoColumnWidth = 174 * kPointsPerMillimetre;

/// Who made a figure, as its file says: the creator of a PDF, the software of a PNG, the name of
/// the root of a glTF scene.
inline constexpr char kFigureMaker[] = "regrasp figure";

/// Writes the maker into the bytes of an SVG or a PNG, where their programs look for it: a comment
/// after the first line, a text chunk after the header. A PDF gets it from Cairo as it is made.
/// @param bytes  a whole file of the format.
void MarkFigure(FigureFormat format, std::string& bytes);

/// Whether these are the bytes of a marked figure of any format.
[[nodiscard]] bool IsMarkedFigure(const std::string& bytes);

/// A white page that Cairo draws on, in points (1/72 inch) from the top left, and the bytes of a
/// file of it.
///
/// Deterministic: the same drawing gives the same bytes, as no date or random number gets in.
class FigurePage {
 public:
  /// @param width, height  points; positive. A PNG has 300 dots per inch, fewer where a side would
  ///                       be longer than Cairo can draw.
  /// @param magnification  how much larger everything is in the file, text and lines too.
  /// @throws EnvironmentError  Cairo cannot make the page.
  FigurePage(FigureFormat format, double width, double height, double magnification = 1);

  [[nodiscard]] cairo_t* context() const { return context_.get(); }

  /// Ends the page and returns the file's bytes; to be called once, at the end.
  /// @throws EnvironmentError  Cairo failed, now or while drawing.
  [[nodiscard]] std::string Finish();

 private:
  [[nodiscard]] cairo_surface_t* MakeSurface(double width, double height);

  FigureFormat format_;
  std::unique_ptr<std::string> bytes_;  ///< Cairo keeps its address
  double scale_ = 1;                    ///< pixels per point
  CairoSurface surface_;
  CairoContext context_;
};

}  // namespace regrasp::render
