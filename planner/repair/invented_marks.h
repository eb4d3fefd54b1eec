#pragma once

#include "planner/object/polygon_soup.h"
#include "planner/repair/comparison.h"

namespace regrasp::repair {

/// Marks the facets of a solid that were invented: those that the comparison with its original
/// says are none of it, and those that lie where an earlier repair invented the original's.
/// @param original  as the file has it, with its marks.
/// @param comparison  of the two; without marks where they are the same.
void MarkInvented(const object::PolygonSoup& original, const Comparison& comparison,
                  object::PolygonSoup& solid);

/// The share of the area that is marked.
[[nodiscard]] double InventedShare(const object::PolygonSoup& solid);

/// Sorts the facets that were invented behind the others, as the file of a solid has them.
void InventedLast(object::PolygonSoup& solid);

}  // namespace regrasp::repair
