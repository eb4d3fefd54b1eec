#pragma once

#include <span>
#include <string>

#include "render/frames/camera.h"
#include "render/frames/finger_glyph.h"
#include "render/picture/image.h"

namespace regrasp::render {

/// How text is written on frames.
struct TextStyle {
  double font = 0;  ///< pixels
  Ground ground = {};
};

/// Smaller text is left out.
inline constexpr double kSmallestFont = 7;  ///< pixels

/// Of frames of this size: the same for all shapes of the same area.
[[nodiscard]] double FontSize(int width, int height);

/// Writes on a picture: the fingers' numbers in their colours, a ring around each finger that was
/// just placed, the caption at the bottom left, and a scale bar at the bottom right (its length
/// holds at the centre of the object). A caption that is too long for a line takes two. What does
/// not fit a small image is left out.
/// @param metres_per_unit  of the picture's frame.
[[nodiscard]] Image Annotate(const Image& image, const Camera& camera,
                             std::span<const FingerGlyph> fingers, const std::string& caption,
                             double metres_per_unit, const TextStyle& style);

}  // namespace regrasp::render
