#pragma once

#include <string>

#include "planner/object/polygon_soup.h"

namespace regrasp {

/// Reads a file with assimp in this process. Only for a process that may be lost: see
/// ReadWithAssimp.
/// @throws InputError  assimp says no, or its indices point nowhere; without the file's name.
[[nodiscard]] PolygonSoup ReadAssimpScene(const std::string& path);

}  // namespace regrasp
