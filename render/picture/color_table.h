#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "render/picture/image.h"
#include "render/picture/palette.h"

namespace regrasp::render {

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
