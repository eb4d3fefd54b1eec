#pragma once

#include <vector>

#include "planner/plan/snapshot.h"
#include "render/frames/canvas.h"
#include "render/frames/facet_mesh.h"
#include "render/frames/finger_glyph.h"

namespace regrasp::render {

/// A hand that frames show: the meshes of its links, in their own frames, metres. Where they are
/// says plan::Snapshot::links_W, in the same order.
using HandView = std::vector<FacetMesh>;

/// The side of the hand that is seen is laid over the frame with this opacity: contacts and cones
/// show through.
inline constexpr double kHandOpacity = 0.6;

/// The same meshes in the picture's unit of length.
[[nodiscard]] HandView InPicture(HandView hand, const PictureFrame& frame);

/// The links of a snapshot; none where it has no hand.
/// @param first_mesh  of the hand's, among the canvas's.
[[nodiscard]] std::vector<Shape> HandShapes(const plan::Snapshot& snapshot,
                                            const PictureFrame& frame, int first_mesh);

}  // namespace regrasp::render
