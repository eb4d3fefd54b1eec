#pragma once

#include <string_view>

#include "planner/object/polygon_soup.h"

namespace regrasp::object {

/// Read the bytes of a glTF 2.0 file (`.gltf`, `.glb`), in metres: the triangles of its scene,
/// placed by their nodes.
///
/// Points, lines, materials, cameras and animations are ignored. Features that move or add
/// vertices are refused: skins, morph weights other than 0, instancing, compression, hidden nodes,
/// and every required extension that is not known to leave the geometry alone. A file with several
/// scenes must name one. KHR_mesh_quantization is read.
/// Source: glTF 2.0 Specification (Khronos, 2021).
/// @throws InputError  without the file's name: JSON pointer and problem.
[[nodiscard]] PolygonSoup ReadGltf(std::string_view bytes);

}  // namespace regrasp::object
