#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "planner/base/index.h"

namespace regrasp::render {

/// An sRGB colour with 8 bits per channel.
struct Color {
  unsigned char r = 0;
  unsigned char g = 0;
  unsigned char b = 0;
};

/// Return the colour of a finger in all images. Colours repeat after five fingers.
///
/// The five hues are distinguishable with common colour vision deficiencies (after Okabe and Ito
/// 2008, and Tol 2021). Their lightness increases in steps (CIE L* 31, 41, 52, 65, 76), so that
/// they also differ in greyscale.
[[nodiscard]] Color FingerColor(FingerIndex finger);

inline constexpr Color kWhite = {255, 255, 255};
inline constexpr Color kInk = {34, 40, 52};  ///< edges of the object, and text
/// Colours of actual and expected values in images of a failure.
inline constexpr Color kFaultRed = {214, 16, 32};
inline constexpr Color kExpected = {0, 122, 61};
inline constexpr Color kForceInk = {20, 24, 32};  ///< force arrows

/// Background of frames and colours that are visible on it.
struct Ground {
  Color paper = kWhite;
  Color ink = kInk;
  Color force = kForceInk;
  Color halo = kWhite;            ///< outline of text and rings
  Color rotation = {64, 72, 96};  ///< arrow that shows the rotation of an object in a hand
};
inline constexpr Ground kWhiteGround = {};
inline constexpr Ground kDarkGround = {
    {27, 31, 39}, {216, 222, 232}, {244, 246, 250}, {27, 31, 39}, {176, 188, 214}};

/// Colours of contact clusters: pale, so that fingers are visible in front of them.
inline constexpr std::array<Color, 8> kClusterPalette = {{{158, 202, 225},
                                                          {253, 205, 150},
                                                          {186, 222, 170},
                                                          {244, 184, 196},
                                                          {204, 192, 228},
                                                          {240, 232, 160},
                                                          {170, 220, 212},
                                                          {214, 200, 184}}};

inline constexpr Color kMaterial = {234, 238, 243};  ///< area of the object in figures
inline constexpr Color kBodyOutside = {148, 184, 226};
inline constexpr Color kBodyInside = {186, 208, 236};

/// Encode an integer as in PNG files, most significant byte first.
[[nodiscard]] std::string PngInteger(std::uint32_t number);

/// Encode a chunk of a PNG file (PNG specification, section 5.3).
/// @param type  chunk type, four letters.
[[nodiscard]] std::string PngChunk(const std::string& type, const std::string& data);

/// An RGB image with 8 bits per channel, rows from top to bottom.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgb;  ///< 3 · width · height bytes
  /// Opacity, width · height bytes; `rgb` then contains the image on white. Empty if the image is
  /// opaque.
  std::vector<unsigned char> alpha = {};
};

/// Return an image whose channels all have the value `brightness`.
[[nodiscard]] Image MakeImage(int width, int height, unsigned char brightness = 255);

/// Compute a transparent image from the same drawing on white and on black.
/// @throws std::invalid_argument  if the sizes differ.
[[nodiscard]] Image MakeTransparent(Image on_white, const Image& on_black);

/// Average blocks of `factor` × `factor` pixels.
/// @throws std::invalid_argument  if a side is not a multiple of `factor`.
[[nodiscard]] Image Shrink(const Image& image, int factor);

/// Encode an image as a PNG file, with an alpha channel if the image is not opaque.
[[nodiscard]] std::string EncodePng(const Image& image);

/// Write an image as a PNG file.
/// @throws EnvironmentError  if the file cannot be written.
void WritePng(const std::filesystem::path& path, const Image& image);

}  // namespace regrasp::render
