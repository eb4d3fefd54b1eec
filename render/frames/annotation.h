#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "render/frames/camera.h"
#include "render/frames/finger_glyph.h"
#include "render/picture/caption.h"
#include "render/picture/image.h"

namespace regrasp::render {

class CairoImage;

/// Style of text on frames.
struct TextStyle {
  double font = 0;  ///< font size, pixels
  Ground ground = {};
};

/// Smallest font size that is drawn, pixels. Smaller text is omitted.
inline constexpr double kSmallestFont = 7;

/// Return the font size for frames of a size in pixels. It depends only on the area.
[[nodiscard]] double FontSize(int width, int height);

/// Draw a ring around each finger that was just placed.
void DrawRings(const CairoImage& image, const Camera& camera, std::span<const FingerGlyph> fingers,
               const TextStyle& style);

/// Draw the caption at the bottom left and a scale bar at the bottom right.
///
/// The length of the bar applies at the centre of the object. A long caption takes two lines. Text
/// that does not fit a small image is omitted.
/// @param metres_per_unit  unit of length of the camera's frame, metres.
/// @returns the areas covered by caption and bar.
[[nodiscard]] std::vector<Obstacle> DrawCaption(const CairoImage& image, const Camera& camera,
                                                const std::string& caption, double metres_per_unit,
                                                const TextStyle& style);

/// Draw the motion of the object up to now at the top right, in bold.
/// @returns the covered area.
[[nodiscard]] std::vector<Obstacle> DrawProgress(const CairoImage& image, const Camera& camera,
                                                 const std::string& progress,
                                                 const TextStyle& style);

/// Return the areas of fingers that labels should not cover.
[[nodiscard]] std::vector<Obstacle> ObstaclesOf(const Camera& camera,
                                                std::span<const FingerGlyph> fingers);

/// Draw the name or number of each finger in its colour, on top of everything drawn before.
///
/// If sliding fingers do not start together, their order ("1st" and so on) is written next to their
/// start positions.
/// @param names    names of fingers by index; other fingers have their number.
/// @param covered  areas that numbers should not cover, in addition to fingers.
void DrawNumbers(const CairoImage& image, const Camera& camera,
                 std::span<const FingerGlyph> fingers, std::span<const std::string> names,
                 std::span<const Obstacle> covered, const TextStyle& style);

/// A round magnified part of a frame that shows the path of a finger that its fingertip sphere
/// hides.
struct AlignInset {
  FingerGlyph glyph;
  /// Position of the fingertip sphere in the image, pixels.
  Eigen::Vector2d fingertip = Eigen::Vector2d::Zero();
  /// Centre in the image, pixels, like the radius.
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0;
  double magnification = 1;
  Camera camera;  ///< magnifying camera, with the middle of the path at the centre
};

/// Place an inset for each finger whose sliding step is shorter than the diameter of its fingertip.
///
/// A step that would be invisible even in its inset has none. Insets have the positions that cover
/// least. Images too small for text have no insets.
/// @param covered  areas that insets should not cover, in addition to fingers.
[[nodiscard]] std::vector<AlignInset> PlaceInsets(const Camera& camera,
                                                  std::span<const FingerGlyph> fingers,
                                                  std::span<const Obstacle> covered,
                                                  const TextStyle& style);

/// Draw an inset: start position (pale), path with arrow head, end position, magnification, and a
/// line to the fingertip.
/// @param body  image of the object alone, from the camera of the inset.
/// @returns the covered area.
[[nodiscard]] std::vector<Obstacle> DrawInset(const CairoImage& image, const AlignInset& inset,
                                              const Image& body, const TextStyle& style);

}  // namespace regrasp::render
