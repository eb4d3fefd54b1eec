#pragma once

#include <span>
#include <string>
#include <vector>

#include "render/frames/camera.h"
#include "render/frames/finger_glyph.h"
#include "render/picture/color_table.h"
#include "render/picture/label_layout.h"

namespace regrasp::render {

class CairoImage;

/// How text is written on frames.
struct TextStyle {
  double font = 0;  ///< pixels
  Ground ground = {};
};

/// Smaller text is left out.
inline constexpr double kSmallestFont = 7;  ///< pixels

/// Of frames of this size: the same for all shapes of the same area.
[[nodiscard]] double FontSize(int width, int height);

/// Draws a ring around each finger that was just placed.
void DrawRings(const CairoImage& page, const Camera& camera, std::span<const FingerGlyph> fingers,
               const TextStyle& style);

/// Writes the caption at the bottom left, and a scale bar at the bottom right (its length holds at
/// the centre of the object). A caption that is too long for a line takes two. What does not fit a
/// small image is left out.
/// @param metres_per_unit  of the picture's frame.
/// @returns what they cover.
[[nodiscard]] std::vector<Obstacle> DrawCaption(const CairoImage& page, const Camera& camera,
                                                const std::string& caption, double metres_per_unit,
                                                const TextStyle& style);

/// What of fingers labels should not cover.
[[nodiscard]] std::vector<Obstacle> ObstaclesOf(const Camera& camera,
                                                std::span<const FingerGlyph> fingers);

/// Writes the fingers' numbers in their colours, and the order in which they align ("1st") where
/// they do not together, beside where they came from. They come last, over everything.
/// @param covered  what they should not cover, besides fingers.
void DrawNumbers(const CairoImage& page, const Camera& camera, std::span<const FingerGlyph> fingers,
                 std::span<const Obstacle> covered, const TextStyle& style);

}  // namespace regrasp::render
