#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace regrasp::render {

/// PNG's integers have their highest byte first.
[[nodiscard]] std::string PngInteger(std::uint32_t number);

/// A chunk of a PNG file (PNG specification, 5.3).
/// @param type  four letters.
[[nodiscard]] std::string PngChunk(const std::string& type, const std::string& data);

/// An image, 8 bits RGB, rows from the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgb;  ///< 3 · width · height
  /// width · height where something shines through: then `rgb` is the picture on white. Empty where
  /// it is opaque.
  std::vector<unsigned char> alpha = {};
};

/// An image whose every channel is `brightness`.
[[nodiscard]] Image MakeImage(int width, int height, unsigned char brightness = 255);

/// A picture through which the ground shines, from the same drawing on white and on black.
/// @throws std::invalid_argument  their sizes differ.
[[nodiscard]] Image MakeTransparent(Image on_white, const Image& on_black);

/// Averages blocks of `factor` × `factor` pixels into one.
/// @throws std::invalid_argument  a side is not a multiple of `factor`.
[[nodiscard]] Image Shrink(const Image& image, int factor);

/// The bytes of a PNG file, with an alpha channel where the image has one.
[[nodiscard]] std::string EncodePng(const Image& image);

/// @throws EnvironmentError  the file cannot be written.
void WritePng(const std::filesystem::path& path, const Image& image);

}  // namespace regrasp::render
