#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "render/figures/figure_format.h"

namespace regrasp::render {

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
