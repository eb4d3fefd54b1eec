#pragma once

#include <string>
#include <string_view>

#include "planner/object/polygon_soup.h"

namespace regrasp::object {

/// Reads the bytes of a COLLADA or FBX file with assimp in this process. Only for a process that
/// may be lost: see ReadWithAssimp.
///
/// Coordinates are those of the file, whatever it names as the upward axis.
/// No file is opened. Files that make no difference to the surface (materials, textures,
/// animations) are told to be missing.
/// @param file  the file's name without folders; assimp chooses a reader by its ending, .dae or
/// .fbx.
/// @throws InputError  it holds what assimp would misread, assimp refuses it, its indices point
/// nowhere, or it asks for another file that
///                     the surface may come from; without the file's name.
[[nodiscard]] PolygonSoup ReadAssimpScene(std::string_view bytes, const std::string& file);

}  // namespace regrasp::object
