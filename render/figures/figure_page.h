#pragma once

#include <cairo.h>

#include <memory>
#include <string>

#include "render/figures/figure_format.h"
#include "render/picture/cairo_paint.h"

namespace regrasp::render {

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
