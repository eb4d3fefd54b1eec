#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "planner/base/index.h"
#include "render/figures/panel_sheet.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/caption.h"
#include "render/picture/image.h"

namespace regrasp::render {

/// A white page for drawing with Cairo, in points (1/72 inch) from the top left corner.
///
/// Deterministic: the same drawing gives the same bytes, without dates or random numbers.
class FigurePage {
 public:
  /// Create a page.
  /// @param width, height  size in points, positive. A PNG has 300 dots per inch, or fewer if a
  ///               side exceeds Cairo's limit.
  /// @param magnification  scale factor of everything in the file, including text and lines.
  /// @param family  font family of all text; empty for the default one.
  /// @throws EnvironmentError  if Cairo cannot create the page.
  FigurePage(FigureFormat format, double width, double height, double magnification = 1,
             const std::string& family = {});

  [[nodiscard]] cairo_t* context() const { return context_.get(); }

  /// End the page and return the bytes of the file. Must be called once, last.
  /// @throws EnvironmentError  if Cairo failed, now or while drawing.
  [[nodiscard]] std::string Finish();

 private:
  [[nodiscard]] cairo_surface_t* MakeSurface(double width, double height);

  FigureFormat format_;
  std::unique_ptr<std::string> bytes_;  ///< Cairo stores its address
  double scale_ = 1;                    ///< scale of a PNG, pixels per point
  CairoSurface surface_;
  CairoContext context_;
};

/// Height of the scale bar at the bottom of a panel, points.
inline constexpr double kScaleBarSpace = 14;

/// Return the length of a panel's scale bar, metres: the longest round length (RoundLength) up to a
/// quarter of the panel's width.
/// @param width  width of the panel, points.
[[nodiscard]] double ScaleBarLength(double width, double points_per_metre);

/// Draw the scale bar with its length at the bottom right of a panel.
/// @param panel  size of the panel, points.
void DrawScaleBar(cairo_t* cr, const Eigen::Vector2d& panel, double points_per_metre);

/// Radius of the circle that a finger's number needs, points.
inline constexpr double kNumberRadius = 4.8;

/// Draw names of fingers or grasps near their anchors (PlaceLabels), with leader lines to distant
/// ones.
/// @param panel  size of the panel, points; names stay inside.
/// @returns the centres of the names.
std::vector<Eigen::Vector2d> DrawNumbers(cairo_t* cr, std::span<const std::string> names,
                                         std::span<const LabelAnchor> anchors,
                                         std::span<const Obstacle> obstacles,
                                         const Eigen::Vector2d& panel);

/// Font sizes of captions and finger numbers, points: readable in print.
inline constexpr double kCaptionFont = 7.5;
inline constexpr double kNumberFont = 7.5;
inline constexpr double kLabelFont = 6.5;  ///< font size of axes
inline constexpr double kLineHeight = 1.25 * kCaptionFont;

/// Break a caption into lines of at most `width` points, unless a word is longer.
///
/// Lines break after semicolons, or between words if necessary. Numbers stay with the preceding
/// word.
/// @param family  font family; empty for the default one.
[[nodiscard]] std::vector<std::string> WrapCaption(const std::string& caption, double width,
                                                   const std::string& family = {});

/// Return the height of a caption with the space below it, points.
[[nodiscard]] inline double CaptionHeight(std::size_t lines) {
  return (static_cast<double>(lines) + 0.5) * kLineHeight;
}

/// Draw lines centred at x, the first one below `top`.
void DrawCaption(cairo_t* cr, const std::vector<std::string>& lines, double x, double top);

/// Draw a figure with its caption below it, unless the style has no captions.
/// @param style  format, font family and captions.
/// @param size  size of the drawing, points.
/// @param magnification  magnification of the page (FigurePage).
/// @returns the bytes of the file.
[[nodiscard]] std::string DrawWithCaption(const FigureStyle& style, const Eigen::Vector2d& size,
                                          const std::string& caption,
                                          const std::function<void(cairo_t*)>& draw,
                                          double magnification = 1);

/// Alignment of a line of text relative to its position.
enum class TextAlign { kLeft, kCentre, kRight };

/// Draw a line of text of an axis.
/// @param base  position on the baseline.
void DrawLabel(cairo_t* cr, const std::string& text, const Eigen::Vector2d& base, TextAlign align);

/// Return the width of a text of an axis, points.
[[nodiscard]] double LabelWidth(cairo_t* cr, const std::string& text);

/// Return the width of a bold name or number, points.
[[nodiscard]] double MarkWidth(cairo_t* cr, const std::string& text);

/// Draw a bold name or number, centred, with a white halo.
void DrawMark(cairo_t* cr, const std::string& text, const Eigen::Vector2d& centre);

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
  bool ring = false;              ///< whether the contact has the ring of a placed finger
  double radius = kMarkerRadius;  ///< radius of the disc with the same area, points

  /// Return the distance from the centre to the outer border, with the ring, points.
  [[nodiscard]] double reach() const;
};

/// Enlarge markers that others cover by more than half, so that a rim stays visible on the side
/// away from the covering one. Contacts at one position are drawn nested.
/// @param markers  markers in drawing order.
void EnlargeCovered(std::span<FingerMarker> markers);

void DrawFingerMarker(cairo_t* cr, const FingerMarker& marker);

/// Mix a colour with white.
/// @param share  share of the colour, 0 to 1.
[[nodiscard]] Color Paler(Color color, double share);

/// Share of the colour of elements behind an object.
inline constexpr double kBehindShare = 0.45;

}  // namespace regrasp::render
