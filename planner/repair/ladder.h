#pragma once

#include <optional>
#include <string>

#include "planner/object/object.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/reading.h"
#include "planner/repair/comparison.h"
#include "planner/repair/repair.h"

namespace regrasp::repair {

/// What the climb came to.
struct Climbed {
  Attempt attempt;
  std::optional<object::PolygonSoup> solid;  ///< none: no stage gave one
  Comparison comparison;                     ///< of the solid
};

/// Climbs from stage to stage until what comes out is a solid that the reader takes and that keeps
/// to the options' limits (repair.h).
/// @throws TimeUp  the deadline came.
[[nodiscard]] Climbed Climb(const object::PolygonSoup& soup, const std::string& name,
                            const object::RepairOptions& options, const object::Reading& reading);

}  // namespace regrasp::repair
