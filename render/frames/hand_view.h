#pragma once

#include <vector>

#include "render/frames/facet_mesh.h"

namespace regrasp::render {

/// A hand that frames show: the meshes of its links, in their own frames, metres. Where they are
/// says plan::Snapshot::links_W, in the same order.
using HandView = std::vector<FacetMesh>;

/// The side of the hand that is seen is laid over the frame with this opacity: contacts and cones
/// show through.
inline constexpr double kHandOpacity = 0.6;

}  // namespace regrasp::render
