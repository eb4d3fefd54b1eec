#pragma once

#include <string_view>

#include "planner/object/polygon_soup.h"

namespace regrasp::object {

/// Read the bytes of a 3MF file; coordinates are converted to metres.
///
/// Build items and their components place the objects. The unit is millimetre if the model names
/// none. assimp 5.2 is not used because it crashes on components and ignores the unit. Call it only
/// in a process that may crash: see ReadWithAssimp. Source: 3MF Core Specification 1.3, chapters 3
/// and 4.
/// @throws InputError  if the bytes are not a ZIP archive with a model in XML, a number or a
///     reference is invalid, or there are more than kMaxFacets triangles; the text does not contain
///     the file's name.
[[nodiscard]] PolygonSoup Read3mf(std::string_view bytes);

}  // namespace regrasp::object
