#pragma once

#include <span>
#include <string>

#include "render/frames/camera.h"
#include "render/frames/finger_glyph.h"
#include "render/picture/image.h"

namespace regrasp::render {

/// Writes on a picture: the fingers' numbers in their colours, a ring around each finger that was
/// just placed, the caption at the bottom left, and a scale bar at the bottom right (its length
/// holds at the centre of the object). What does not fit a small image is left out.
/// @param metres_per_unit  of the picture's frame.
[[nodiscard]] Image Annotate(const Image& image, const Camera& camera,
                             std::span<const FingerGlyph> fingers, const std::string& caption,
                             double metres_per_unit);

}  // namespace regrasp::render
