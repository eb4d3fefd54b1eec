#pragma once

#include <array>

#include "planner/base/index.h"

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

}  // namespace regrasp::render
