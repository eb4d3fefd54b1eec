#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace regrasp::render {

/// An image, 8 bits RGB, rows from the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgb;  ///< 3 · width · height
};

/// An image whose every channel is `brightness`.
[[nodiscard]] Image MakeImage(int width, int height, unsigned char brightness = 255);

/// Averages blocks of `factor` × `factor` pixels into one.
/// @throws std::invalid_argument  a side is not a multiple of `factor`.
[[nodiscard]] Image Shrink(const Image& image, int factor);

/// The bytes of a PNG file.
[[nodiscard]] std::string EncodePng(const Image& image);

/// @throws EnvironmentError  the file cannot be written.
void WritePng(const std::filesystem::path& path, const Image& image);

}  // namespace regrasp::render
