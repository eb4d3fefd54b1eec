#pragma once

#include <string_view>

#include "planner/object/polygon_soup.h"

namespace regrasp::object {

/// Reads the bytes of a 3MF file, in metres: the model of the package, its objects where the build
/// items and their components place them, in its unit (millimetres where it names none).
///
/// Written here because assimp 5.2 crashes on components and passes over the unit. Only for a
/// process that may be lost: see ReadWithAssimp.
/// Source: 3MF Core Specification 1.3, chapters 3 and 4.
/// @throws InputError  without the file's name: no ZIP, no model in it, no XML, a number or a
///                     reference that is none, more than kMaxFacets facets.
[[nodiscard]] PolygonSoup Read3mf(std::string_view bytes);

}  // namespace regrasp::object
