#pragma once

#include <memory>
#include <string>

#include "render/picture/image.h"
#include "render/picture/moving_picture.h"

namespace regrasp::render {

/// An image as a WebP file, lossy: a tenth of the bytes of a PNG, for pages and mail.
/// @param width  the image is scaled down to this many pixels where it is wider.
/// @throws std::invalid_argument  the image is empty or wider or higher than WebP can hold (16383),
///                                or width < 1.
[[nodiscard]] std::string EncodeWebp(const Image& image, int width);

/// An animated WebP, lossy.
/// @throws std::invalid_argument  a size that WebP cannot hold.
[[nodiscard]] std::unique_ptr<MovingPicture> MakeWebpAnimation(int width, int height);

}  // namespace regrasp::render
