#pragma once

#include <string>
#include <string_view>

#include "planner/object/polygon_soup.h"

namespace regrasp::object {

/// Reads the bytes of a file with assimp in this process. Only for a process that may be lost: see
/// ReadWithAssimp.
///
/// No file is opened. Files that make no difference to the surface (materials, textures,
/// animations) are told to be missing.
/// @param file  the file's name without folders; assimp chooses a reader by its ending.
/// @throws InputError  assimp says no, its indices point nowhere, or it asks for another file that
///                     the surface may come from; without the file's name.
[[nodiscard]] PolygonSoup ReadAssimpScene(std::string_view bytes, const std::string& file);

}  // namespace regrasp::object
