#pragma once

#include <span>
#include <vector>

#include "render/frames/annotation.h"
#include "render/frames/body_shape.h"
#include "render/frames/camera.h"
#include "render/frames/fault_picture.h"
#include "render/frames/finger_glyph.h"
#include "render/picture/label_layout.h"

namespace regrasp::render {

class CairoImage;

/// Points that the marks go as far as, metres, world frame; of cones, which are as long as those of
/// the fingers, their apex alone.
[[nodiscard]] std::vector<Eigen::Vector3d> ExtentOf(const FaultMarks& marks, double diameter_m);

/// Draws what is wrong over the picture of a failed step: in red what is, in green what should be,
/// with lengths and angles; the push and the object's ghost where a replay moved it; and what
/// failed as a heading at the top left.
/// @param fingers  as they are drawn: texts keep clear of them.
/// @returns what is covered by lines and texts.
std::vector<Obstacle> DrawFaultMarks(const CairoImage& page, const Camera& camera,
                                     const PictureFrame& frame, const BodyShape& body,
                                     std::span<const FingerGlyph> fingers, const FaultMarks& marks,
                                     const TextStyle& style);

}  // namespace regrasp::render
