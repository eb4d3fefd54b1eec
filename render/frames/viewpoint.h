#pragma once

#include <vector>

#include "render/frames/body_shape.h"
#include "render/frames/camera.h"
#include "render/frames/finger_glyph.h"

namespace regrasp::render {

/// Where the pictures of a sequence are taken from.
///
/// Tries directions around the object from a little above (and, less gladly, from below) and takes
/// the one from which most contacts are in full view, fingers and cones cover each other least, and
/// few faces are seen edge-on. A planar object is seen from almost straight above.
/// @param frames  the fingers of every frame of the sequence.
/// @returns the unit vector from the object towards the camera.
[[nodiscard]] Eigen::Vector3d ChooseViewpoint(const BodyShape& body, bool planar,
                                              const std::vector<std::vector<FingerGlyph>>& frames);

}  // namespace regrasp::render
