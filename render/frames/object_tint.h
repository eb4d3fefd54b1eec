#pragma once

#include "render/frames/shaded_mesh.h"

namespace regrasp::render {

/// Give a surface colours that depend on its normals in the object frame.
///
/// Each of the directions ±x, ±y and ±z has its own pale colour of about the same lightness, and
/// directions between them have mixed colours. The colours rotate with the object and show its
/// orientation, for polyhedra and for curved objects.
void TintByDirection(ShadedMesh& surface);

}  // namespace regrasp::render
