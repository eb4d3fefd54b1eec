#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "render/picture/image.h"

namespace regrasp::render {

/// Deleter of Cairo's surfaces and contexts.
struct CairoDeleter {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, CairoDeleter>;
using CairoContext = std::unique_ptr<cairo_t, CairoDeleter>;

/// Set the colour of the next stroke or fill.
void SetColor(cairo_t* cr, Color color, double opacity = 1);

/// Start a new path: a box given by its top left corner, or a circle.
void SetBox(cairo_t* cr, const Eigen::Vector2d& corner, const Eigen::Vector2d& size);
void SetCircle(cairo_t* cr, const Eigen::Vector2d& centre, double radius);

/// Fill or stroke the current path and clear it.
void Fill(cairo_t* cr, Color color, double opacity = 1);
void Stroke(cairo_t* cr, Color color, double width);
void FillAndStroke(cairo_t* cr, Color fill, Color border, double width);
/// Stroke the current path in the colour of the halo and fill it.
void FillWithHalo(cairo_t* cr, Color color, double halo, Color halo_color = kWhite);

/// Mark a point by a black dot with a white rim.
void DrawDot(cairo_t* cr, const Eigen::Vector2d& at, double radius);

/// A pattern of parallel lines that rise to the right.
struct Hatch {
  double slope;
  double spacing;  ///< distance between lines, perpendicular to them
  double width;
};
/// Hatch a box within the current clip region.
void DrawHatch(cairo_t* cr, const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
               const Hatch& hatch, Color color);

/// Select the font of all images.
///
/// For each family name, Cairo keeps the hinting of its first use for the life of the process. To
/// use a different hinting than frames, pass another name of the same font.
void SelectFont(cairo_t* cr, double size, bool bold, const char* family = "sans-serif");
/// Return the advance width of a text in the current font.
[[nodiscard]] double TextWidth(cairo_t* cr, const std::string& text);
/// Break a text at spaces into lines of at most `most` in the current font, unless a word is
/// longer. A number and its unit are one word.
[[nodiscard]] std::vector<std::string> BreakLines(cairo_t* cr, const std::string& text,
                                                  double most);
/// Return the position at which a text must start so that its ink is centred.
[[nodiscard]] Eigen::Vector2d CentredText(cairo_t* cr, const std::string& text,
                                          const Eigen::Vector2d& centre);

/// Add a closed polygon to the current path.
void AddOutline(cairo_t* cr, std::span<const Eigen::Vector2d> points);

/// Stroke a straight line in the current colour.
void StrokeLine(cairo_t* cr, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width);

/// Length of the head of every arrow, points.
inline constexpr double kArrowHead = 4.2;

/// Stroke an open path in the current colour, with an arrow head that ends at the last point. The
/// head of a path shorter than kArrowHead has the length of the path.
void StrokeArrow(cairo_t* cr, std::span<const Eigen::Vector2d> path, double width);

/// Draw an arrow with a head in proportion to the width, on a halo.
void DrawArrow(cairo_t* cr, std::span<const Eigen::Vector2d> path, double width, Color color,
               Color halo);

/// An image that Cairo draws on.
class CairoImage {
 public:
  /// Copy an image.
  /// @throws std::runtime_error  if Cairo has no memory, or if a side exceeds the 32767 pixels that
  ///                             it supports.
  explicit CairoImage(const Image& image);

  [[nodiscard]] cairo_t* context() const { return context_.get(); }
  [[nodiscard]] cairo_surface_t* surface() const { return surface_.get(); }
  [[nodiscard]] Image ToImage() const;

 private:
  [[nodiscard]] std::uint32_t* Row(int y) const;

  int width_, height_;
  CairoSurface surface_;
  CairoContext context_;
};

}  // namespace regrasp::render
