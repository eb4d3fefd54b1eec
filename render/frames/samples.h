#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/frames/canvas.h"
#include "render/frames/offscreen_context.h"

namespace regrasp::render {

/// Alpha of an opaque sample.
inline constexpr int kFullAlpha = 255;

/// A band of samples that starts at row `top` of the image, stored from the last row up.
struct SampleBand {
  int width, top, rows, factor;
};

/// Set the sums of all pixels outside a box.
void FillOutside(const PixelBox& box, const SampleBand& band,
                 const std::array<std::uint32_t, 3>& color, std::vector<std::uint32_t>& sums);

/// Add the RGBA samples of a box, from bottom to top, to the sums of their pixels in the band.
/// @param box  its limits are multiples of the band's factor.
void AddSamples(const unsigned char* samples, const SampleBand& band, const PixelBox& box,
                int weight, std::vector<std::uint32_t>& sums);

/// Return the smallest box that contains all samples of `within` whose alpha is not 0.
[[nodiscard]] PixelBox VisibleBox(const std::vector<unsigned char>& samples, const SampleBand& band,
                                  const PixelBox& within);

/// Lay a colour over a sample, whose alpha changes too.
void Lay(const unsigned char* color, int alpha, unsigned char* sample);

/// Lay an image with its own alpha over the samples of a box.
void LayVisible(const std::vector<unsigned char>& image, const SampleBand& band,
                const PixelBox& box, std::vector<unsigned char>& samples);

/// Reduce the opacity of the samples of a box inside windows.
void FadeInWindows(const std::vector<Window>& windows, const SampleBand& band, const PixelBox& box,
                   std::vector<unsigned char>& samples);

}  // namespace regrasp::render
