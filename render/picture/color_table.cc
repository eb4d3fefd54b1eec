#include "render/picture/color_table.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace regrasp::render {

Color FingerColor(FingerIndex finger) {
  static constexpr std::array<Color, 5> kColors = {{
      {0, 101, 165},   // blue
      {240, 176, 0},   // amber
      {61, 179, 158},  // teal
      {136, 34, 85},   // wine
      {208, 88, 0},    // vermilion
  }};
  const int size = static_cast<int>(kColors.size());
  return kColors[((finger % size) + size) % size];
}

namespace {

constexpr int kChannels = 3;
constexpr std::size_t kMostColors = 256;

using Channels = std::array<unsigned char, kChannels>;

struct Weighted {
  Channels color;
  double weight;
};
using Box = std::span<Weighted>;

struct Spread {
  std::array<double, kChannels> mean = {};
  int channel = 0;   ///< of the largest error
  double error = 0;  ///< weighted squared distances from the mean along that channel
};

Spread SpreadOf(Box box) {
  Spread spread;
  double weight = 0;
  for (const Weighted& entry : box) weight += entry.weight;
  for (int c = 0; c < kChannels; ++c) {
    double sum = 0;
    for (const Weighted& entry : box) sum += entry.weight * entry.color[c];
    spread.mean[c] = sum / weight;
    double error = 0;
    for (const Weighted& entry : box) {
      error += entry.weight * std::pow(entry.color[c] - spread.mean[c], 2);
    }
    if (error <= spread.error) continue;
    spread.channel = c;
    spread.error = error;
  }
  return spread;
}

std::vector<Weighted> WeighColors(std::span<const Image> images) {
  std::map<Channels, double> counts;
  for (const Image& image : images) {
    for (std::size_t i = 0; i + kChannels <= image.rgb.size(); i += kChannels) {
      ++counts[{image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]}];
    }
  }
  std::vector<Weighted> weighted;
  for (const auto& [color, count] : counts) weighted.push_back({color, std::sqrt(count)});
  return weighted;
}

Color Rounded(const std::array<double, kChannels>& mean) {
  const auto channel = [](double value) { return static_cast<unsigned char>(std::lround(value)); };
  return {channel(mean[0]), channel(mean[1]), channel(mean[2])};
}

}  // namespace

std::vector<Color> ChooseColors(std::span<const Image> images, int count) {
  std::vector<Weighted> weighted = WeighColors(images);
  if (weighted.empty() || count < 1) throw std::invalid_argument("ChooseColors: no colour");
  struct Node {
    Box box;
    Spread spread;
  };
  std::vector<Node> nodes = {{weighted, SpreadOf(weighted)}};
  while (static_cast<int>(nodes.size()) < count) {
    Node& node = *std::ranges::max_element(
        nodes, {}, [](const Node& candidate) { return candidate.spread.error; });
    if (node.spread.error == 0) break;
    const int channel = node.spread.channel;
    const auto upper = std::ranges::stable_partition(node.box, [&](const Weighted& entry) {
      return entry.color[channel] <= node.spread.mean[channel];
    });
    const Box lower(node.box.begin(), upper.begin());
    node = {lower, SpreadOf(lower)};
    nodes.push_back({upper, SpreadOf(upper)});
  }
  std::vector<Color> colors;
  for (const Node& node : nodes) colors.push_back(Rounded(node.spread.mean));
  return colors;
}

ColorTable::ColorTable(std::vector<Color> colors) : colors_(std::move(colors)) {
  assert(!colors_.empty() && colors_.size() <= kMostColors);
}

std::uint8_t ColorTable::Nearest(Color color) {
  const std::uint32_t key = (color.r << 16) | (color.g << 8) | color.b;
  const auto [known, is_new] = known_.try_emplace(key);
  if (!is_new) return known->second;
  const auto distance = [color](const Color& other) {
    const int r = other.r - color.r, g = other.g - color.g, b = other.b - color.b;
    return r * r + g * g + b * b;
  };
  const auto nearest = std::ranges::min_element(colors_, {}, distance);
  return known->second = static_cast<std::uint8_t>(nearest - colors_.begin());
}

}  // namespace regrasp::render
