#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace regrasp {

/// Size of captions and of finger numbers, points: readable at the size the page is printed.
inline constexpr double kCaptionFont = 7.5;
inline constexpr double kNumberFont = 7.5;
inline constexpr double kLineHeight = 1.25 * kCaptionFont;

/// The caption in lines no wider than `width` points if words allow it, broken after semicolons,
/// and between words where that does not do; numbers stay with the word before them.
[[nodiscard]] std::vector<std::string> WrapCaption(const std::string& caption, double width);

/// Writes lines centred about x, the first below `top`.
void DrawCaption(cairo_t* cr, const std::vector<std::string>& lines, double x, double top);

/// Writes a finger's number, centred, with a white halo.
void DrawFingerNumber(cairo_t* cr, int finger, const Eigen::Vector2d& centre);

}  // namespace regrasp
