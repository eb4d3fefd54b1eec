#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "render/picture/color_table.h"
#include "render/picture/image.h"

namespace regrasp::render {

/// What Cairo made, destroyed with its holder.
struct CairoDeleter {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, CairoDeleter>;
using CairoContext = std::unique_ptr<cairo_t, CairoDeleter>;

/// Sets what the next stroke or fill paints with.
void SetColor(cairo_t* cr, Color color, double opacity = 1);

/// Begin a path anew: a box by its top left corner, a circle.
void SetBox(cairo_t* cr, const Eigen::Vector2d& corner, const Eigen::Vector2d& size);
void SetCircle(cairo_t* cr, const Eigen::Vector2d& centre, double radius);

/// Fill and stroke the current path, which is gone then.
void Fill(cairo_t* cr, Color color, double opacity = 1);
void Stroke(cairo_t* cr, Color color, double width);
void FillAndStroke(cairo_t* cr, Color fill, Color border, double width);
/// Strokes it in the halo's colour and fills it.
void FillWithHalo(cairo_t* cr, Color color, double halo, Color halo_color = kWhite);

/// Marks a point: a black dot with a white rim.
void DrawDot(cairo_t* cr, const Eigen::Vector2d& at, double radius);

/// Lines that rise to the right.
struct Hatch {
  double slope;
  double spacing;  ///< between lines, measured across
  double width;
};
/// Hatches what the clip leaves of a box.
void DrawHatch(cairo_t* cr, const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
               const Hatch& hatch, Color color);

/// The font of all pictures.
///
/// Cairo keeps for each name of a family the hinting that was asked for first, as long as the
/// process runs: who asks for another hinting than frames have, takes another name of the same
/// font.
void SelectFont(cairo_t* cr, double size, bool bold, const char* family = "sans-serif");
/// How far a text goes in the current font.
[[nodiscard]] double TextWidth(cairo_t* cr, const std::string& text);
/// Where a text begins whose ink is centred.
[[nodiscard]] Eigen::Vector2d CentredText(cairo_t* cr, const std::string& text,
                                          const Eigen::Vector2d& centre);

/// Adds a closed path through these points to the current one.
void AddOutline(cairo_t* cr, std::span<const Eigen::Vector2d> points);

/// Strokes a straight line with the current colour.
void StrokeLine(cairo_t* cr, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width);

/// The head of every arrow, points.
inline constexpr double kArrowHead = 4.2;

/// Strokes an open path with the current colour and ends it with an arrow head whose tip is the
/// last point. A path shorter than the head gets a head that fits it.
void StrokeArrow(cairo_t* cr, std::span<const Eigen::Vector2d> path, double width);

/// The same with a head in proportion to the width, on a halo.
void DrawArrow(cairo_t* cr, std::span<const Eigen::Vector2d> path, double width, Color color,
               Color halo);

/// An image that Cairo draws on.
class CairoImage {
 public:
  /// @throws std::runtime_error  Cairo has no memory, or the image is larger than it can hold
  ///                             (32767 pixels a side).
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
