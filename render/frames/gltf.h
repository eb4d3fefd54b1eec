#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "render/frames/facet_mesh.h"
#include "render/picture/color_table.h"

namespace regrasp::render {

/// One thing of a scene in space.
struct ScenePart {
  std::string name;
  FacetMesh mesh;
  Color color;
  double opacity = 1;
};

/// The bytes of a binary glTF 2.0 file (.glb) of a scene: a node and a mesh for each part, in the
/// parts' unit, which glTF takes for metres, and turned so that z is up there, where glTF has y.
///
/// @param name  of the root node, which has all others.
/// Deterministic: the same parts give the same bytes.
/// @throws EnvironmentError  assimp cannot write it.
[[nodiscard]] std::string EncodeGlb(const std::string& name, const std::vector<ScenePart>& parts);

}  // namespace regrasp::render
