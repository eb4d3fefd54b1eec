#include "render/frames/samples.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace regrasp::render {

namespace {

/// Reduction of a veil's opacity in the middle of a window, and width of the transition per radius.
constexpr double kWindowClearness = 0.7;
constexpr double kWindowRim = 0.55;

/// Blend two channels of a sample, each in the lower byte of half a word, rounded to the nearest.
std::uint32_t MixPair(std::uint32_t color, std::uint32_t sample, std::uint32_t alpha) {
  // For 0 ≤ x ≤ 255², round(x / 255) = (t + t / 256) / 256 with t = x + 128.
  constexpr std::uint32_t kPair = 0x00ff00ff, kHalf = 0x00800080;
  const std::uint32_t t = color * alpha + sample * (kFullAlpha - alpha) + kHalf;
  return ((t + ((t >> 8) & kPair)) >> 8) & kPair;
}

}  // namespace

void AddSamples(const unsigned char* samples, const SampleBand& band, const PixelBox& box,
                int weight, std::vector<std::uint32_t>& sums) {
  const int row = 4 * (box.right - box.left);
  std::vector<std::uint16_t> column(row);  // sums over the sample rows of one pixel row
  for (int bottom = box.top; bottom > box.bottom; bottom -= band.factor) {
    std::ranges::fill(column, 0);
    for (int k = 1; k <= band.factor; ++k) {
      const unsigned char* in =
          samples + std::size_t{4} * (std::size_t(band.width) * (bottom - k) + box.left);
      for (int i = 0; i < row; ++i) column[i] += in[i];
    }
    const std::size_t pixel =
        std::size_t((band.rows - bottom) / band.factor) * (band.width / band.factor) +
        box.left / band.factor;
    std::uint32_t* out = sums.data() + 3 * pixel;
    for (int x = 0; x < row; out += 3) {
      for (int i = 0; i < band.factor; ++i, x += 4) {
        for (int channel = 0; channel < 3; ++channel) out[channel] += weight * column[x + channel];
      }
    }
  }
}

void FillOutside(const PixelBox& box, const SampleBand& band,
                 const std::array<std::uint32_t, 3>& color, std::vector<std::uint32_t>& sums) {
  const int width = band.width / band.factor, rows = band.rows / band.factor;
  const int left = box.left / band.factor, right = box.right / band.factor;
  const int first = rows - box.top / band.factor, end = rows - box.bottom / band.factor;
  for (int y = 0; y < rows; ++y) {
    const bool crosses = y >= first && y < end;
    std::uint32_t* out = sums.data() + std::size_t{3} * width * y;
    for (int x = 0; x < width; ++x, out += 3) {
      if (!crosses || x < left || x >= right) std::ranges::copy(color, out);
    }
  }
}

PixelBox VisibleBox(const std::vector<unsigned char>& samples, const SampleBand& band,
                    const PixelBox& within) {
  PixelBox box = {band.width, band.rows, 0, 0};
  for (int y = within.bottom; y < within.top; ++y) {
    const unsigned char* row = samples.data() + std::size_t{4} * band.width * y;
    int left = within.left;
    while (left < within.right && row[4 * left + 3] == 0) ++left;
    if (left == within.right) continue;
    int right = within.right;
    while (row[4 * right - 1] == 0) --right;
    box = {std::min(box.left, left), std::min(box.bottom, y), std::max(box.right, right), y + 1};
  }
  return box;
}

void Lay(const unsigned char* color, int alpha, unsigned char* sample) {
  constexpr std::uint32_t kPair = 0x00ff00ff;
  std::uint32_t over = 0, below = 0;
  std::memcpy(&over, color, sizeof(over));
  std::memcpy(&below, sample, sizeof(below));
  const std::uint32_t mixed = MixPair(over & kPair, below & kPair, alpha) |
                              MixPair((over >> 8) & kPair, (below >> 8) & kPair, alpha) << 8;
  std::memcpy(sample, &mixed, sizeof(mixed));
}

void LayVisible(const std::vector<unsigned char>& image, const SampleBand& band,
                const PixelBox& box, std::vector<unsigned char>& samples) {
  for (int y = box.bottom; y < box.top; ++y) {
    const std::size_t row = std::size_t(y) * band.width;
    for (std::size_t i = 4 * (row + box.left); i < 4 * (row + box.right); i += 4) {
      if (image[i + 3] != 0) Lay(&image[i], image[i + 3], &samples[i]);
    }
  }
}

void FadeInWindows(const std::vector<Window>& windows, const SampleBand& band, const PixelBox& box,
                   std::vector<unsigned char>& samples) {
  for (const Window& window : windows) {
    const Eigen::Vector2d centre = band.factor * window.centre - Eigen::Vector2d(0, band.top);
    const double radius = band.factor * window.radius;
    const auto clamp = [](double value, int least, int most) {
      return static_cast<int>(std::clamp<double>(value, least, most));
    };
    // Windows count rows from the top.
    const int first_row = band.rows - box.top, end_row = band.rows - box.bottom;
    const int last_x = clamp(centre.x() + radius + 1, box.left, box.right);
    const int last_y = clamp(centre.y() + radius + 1, first_row, end_row);
    for (int y = clamp(centre.y() - radius, first_row, end_row); y < last_y; ++y) {
      for (int x = clamp(centre.x() - radius, box.left, box.right); x < last_x; ++x) {
        const double away = (Eigen::Vector2d(x, y) - centre).norm() / radius;
        if (away >= 1) continue;
        const double fade = std::min(1.0, (1 - away) / kWindowRim);
        const double share = 1 - kWindowClearness * window.strength * fade * fade * (3 - 2 * fade);
        unsigned char& alpha = samples[4 * (std::size_t(band.width) * (band.rows - 1 - y) + x) + 3];
        alpha = static_cast<unsigned char>(std::lround(share * alpha));
      }
    }
  }
}

}  // namespace regrasp::render
