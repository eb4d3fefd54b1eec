#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "planner/base/index.h"
#include "render/picture/image.h"

namespace regrasp::render {

/// A colour, 8 bits a channel, sRGB.
struct Color {
  unsigned char r = 0;
  unsigned char g = 0;
  unsigned char b = 0;
};

/// The colour of a finger in all pictures; it repeats after five fingers, the largest hand.
///
/// The five hues stay apart for the common kinds of colour blindness (after Okabe and Ito 2008, and
/// Tol 2021), and their lightness rises in steps (CIE L* 31, 41, 52, 65, 76), so that they stay
/// apart in grey too.
[[nodiscard]] Color FingerColor(FingerIndex finger);

inline constexpr Color kWhite = {255, 255, 255};
inline constexpr Color kInk = {34, 40, 52};  ///< edges of the object, text
/// What is wrong, and what it should be, in pictures of a failure.
inline constexpr Color kFaultRed = {214, 16, 32};
inline constexpr Color kExpected = {0, 122, 61};
inline constexpr Color kForceInk = {20, 24, 32};  ///< force arrows

/// What frames stand on, and what can be seen on it.
struct Ground {
  Color paper = kWhite;
  Color ink = kInk;
  Color force = kForceInk;
  Color halo = kWhite;        ///< around text and rings
  Color turn = {64, 72, 96};  ///< of an object in a hand
};
inline constexpr Ground kWhiteGround = {};
inline constexpr Ground kDarkGround = {
    {27, 31, 39}, {216, 222, 232}, {244, 246, 250}, {27, 31, 39}, {176, 188, 214}};

/// Clusters of contact points: pale, so that fingers stand out on them.
inline constexpr std::array<Color, 8> kClusterPalette = {{{158, 202, 225},
                                                          {253, 205, 150},
                                                          {186, 222, 170},
                                                          {244, 184, 196},
                                                          {204, 192, 228},
                                                          {240, 232, 160},
                                                          {170, 220, 212},
                                                          {214, 200, 184}}};

inline constexpr Color kMaterial = {234, 238, 243};  ///< of the object in figures
inline constexpr Color kBodyOutside = {148, 184, 226};
inline constexpr Color kBodyInside = {186, 208, 236};

/// At most `count` colours that stand for all colours of the images, by splitting the box of
/// colours with the largest squared error at its mean, across its longest spread, again and again
/// (Wan, Wong, Prusinkiewicz 1988). Deterministic.
///
/// A colour weighs the square root of its pixels: thin lines keep their colours beside a large
/// background, and a colour alone in its box is exact.
/// @throws std::invalid_argument  no image has a pixel, or count < 1.
[[nodiscard]] std::vector<Color> ChooseColors(std::span<const Image> images, int count);

/// Finds the nearest colours of a table.
class ColorTable {
 public:
  /// @param colors  1 to 256.
  explicit ColorTable(std::vector<Color> colors);

  /// The index of the colour with the least squared distance in RGB, of equal ones the first.
  [[nodiscard]] std::uint8_t Nearest(Color color);

  [[nodiscard]] const std::vector<Color>& colors() const { return colors_; }

 private:
  std::vector<Color> colors_;
  std::unordered_map<std::uint32_t, std::uint8_t> known_;
};

}  // namespace regrasp::render
