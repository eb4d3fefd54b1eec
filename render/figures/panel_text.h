#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "render/figures/figure_format.h"
#include "render/picture/label_layout.h"

namespace regrasp::render {

/// Height that a panel gives to its scale bar, below the object, points.
inline constexpr double kScaleBarSpace = 14;

/// How long the scale bar of a panel `width` points wide is, metres: the longest round length
/// (RoundLength) of at most a quarter of the panel.
[[nodiscard]] double ScaleBarLength(double width, double points_per_metre);

/// Draws it with its length at the bottom right of a panel.
void DrawScaleBar(cairo_t* cr, const Eigen::Vector2d& panel, double points_per_metre);

/// Of the circle that a finger's number needs, points.
inline constexpr double kNumberRadius = 4.8;

/// Writes names of fingers or grasps next to what they belong to (PlaceLabels), with a line to it
/// where that is not beside the name.
/// @param panel  its size, points; names stay in it.
/// @returns the centres of the names.
std::vector<Eigen::Vector2d> DrawNumbers(cairo_t* cr, std::span<const std::string> names,
                                         std::span<const LabelAnchor> anchors,
                                         std::span<const Obstacle> obstacles,
                                         const Eigen::Vector2d& panel);

/// Size of captions and of finger numbers, points: readable at the size the page is printed.
inline constexpr double kCaptionFont = 7.5;
inline constexpr double kNumberFont = 7.5;
inline constexpr double kLabelFont = 6.5;  ///< of axes
inline constexpr double kLineHeight = 1.25 * kCaptionFont;

/// The caption in lines no wider than `width` points if words allow it, broken after semicolons,
/// and between words where that does not do; numbers stay with the word before them.
[[nodiscard]] std::vector<std::string> WrapCaption(const std::string& caption, double width);

/// The height of a caption of so many lines, with the space below it.
[[nodiscard]] inline double CaptionHeight(std::size_t lines) {
  return (static_cast<double>(lines) + 0.5) * kLineHeight;
}

/// Writes lines centred about x, the first below `top`.
void DrawCaption(cairo_t* cr, const std::vector<std::string>& lines, double x, double top);

/// A figure with a caption below it, as a file's bytes.
/// @param size  of what is drawn, points.
/// @param magnification  of the page (render/figures/figure_page.h).
[[nodiscard]] std::string DrawWithCaption(FigureFormat format, const Eigen::Vector2d& size,
                                          const std::string& caption,
                                          const std::function<void(cairo_t*)>& draw,
                                          double magnification = 1);

/// Where a line of text lies from the point that it is written at.
enum class TextAlign { kLeft, kCentre, kRight };

/// Writes a line of text of an axis.
/// @param base  on the line's base.
void DrawLabel(cairo_t* cr, const std::string& text, const Eigen::Vector2d& base, TextAlign align);

/// How wide it is, points.
[[nodiscard]] double LabelWidth(cairo_t* cr, const std::string& text);

/// Writes a bold name or number, centred, with a white halo.
void DrawMark(cairo_t* cr, const std::string& text, const Eigen::Vector2d& centre);

}  // namespace regrasp::render
