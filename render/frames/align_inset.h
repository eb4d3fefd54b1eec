#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "render/frames/annotation.h"
#include "render/frames/camera.h"
#include "render/frames/finger_glyph.h"
#include "render/picture/image.h"
#include "render/picture/label_layout.h"

namespace regrasp::render {

class CairoImage;

/// A round magnified part of a picture that shows where a finger came from, and where to, which its
/// ball hides.
struct AlignInset {
  FingerGlyph glyph;
  Eigen::Vector2d ball = Eigen::Vector2d::Zero();    ///< where it is in the picture, pixels
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< as is the radius
  double radius = 0;
  double magnification = 1;
  Camera camera;  ///< sees the middle of the path at the inset's centre, magnified
};

/// One for each finger whose align is shorter than its ball is wide, where it covers least. None in
/// pictures too small for text.
/// @param covered  what they should not cover, besides fingers.
[[nodiscard]] std::vector<AlignInset> PlaceInsets(const Camera& camera,
                                                  std::span<const FingerGlyph> fingers,
                                                  std::span<const Obstacle> covered,
                                                  const TextStyle& style);

/// Draws an inset: the finger's place before, pale, its path with an arrowhead, its place now, how
/// much is magnified, and a line to its ball.
/// @param body  the picture of the object alone, by the inset's camera.
/// @returns what it covers.
[[nodiscard]] std::vector<Obstacle> DrawInset(const CairoImage& page, const AlignInset& inset,
                                              const Image& body, const TextStyle& style);

}  // namespace regrasp::render
