#pragma once

#include <memory>
#include <vector>

#include "render/picture/color_table.h"
#include "render/picture/moving_picture.h"

namespace regrasp::render {

/// H.264 in an MP4 file, a picture every kTick_ms, with the libraries of ffmpeg.
/// @throws std::invalid_argument  no such size.
/// @throws EnvironmentError       libavcodec has no libx264.
[[nodiscard]] std::unique_ptr<MovingPicture> MakeMp4(int width, int height);

/// Of a GIF: one more is for pixels that stay as they are.
inline constexpr int kGifColors = 255;

/// A GIF, with the libraries of ffmpeg, whose images all have these colours: the nearest one a
/// pixel, without dither.
/// @param colors  1 to kGifColors.
/// @throws std::invalid_argument  no such size or number of colours.
[[nodiscard]] std::unique_ptr<MovingPicture> MakeGif(int width, int height,
                                                     const std::vector<Color>& colors);

}  // namespace regrasp::render
