#pragma once

#include "planner/object/polygon_soup.h"
#include "planner/repair/comparison.h"

namespace regrasp::repair {

/// Mark the filled surface of a solid.
/// Marked triangles are those that the comparison marks, and those at which the original itself has
/// marks of an earlier repair.
/// @param original  surface of the file, with its marks.
/// @param comparison  comparison of the two surfaces; a default Comparison marks nothing.
void MarkFilled(const object::PolygonSoup& original, const Comparison& comparison,
                object::PolygonSoup& solid);

/// Return the share of the area that is marked as filled.
[[nodiscard]] double FilledShare(const object::PolygonSoup& solid);

/// Move marked triangles behind all others, as required by the file format of a solid.
void FilledLast(object::PolygonSoup& solid);

}  // namespace regrasp::repair
