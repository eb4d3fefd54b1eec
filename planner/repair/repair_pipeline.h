#pragma once

#include <optional>
#include <string>

#include "planner/object/object.h"
#include "planner/object/polygon_soup.h"
#include "planner/repair/comparison.h"
#include "planner/repair/repair.h"

namespace regrasp::repair {

/// Result of the repair pipeline.
struct PipelineResult {
  Attempt attempt;
  std::optional<object::PolygonSoup> solid;  ///< nullopt if no stage gives one
  Comparison comparison;                     ///< comparison of the solid with the original
};

/// Run the repair stages until one gives a valid solid.
/// A solid is valid if the reader accepts it and it satisfies the limits in `options` (repair.h).
/// @throws TimeUp  if the deadline passes.
[[nodiscard]] PipelineResult RunRepairPipeline(const object::PolygonSoup& soup,
                                               const std::string& name,
                                               const object::RepairOptions& options,
                                               const object::Reading& reading);

}  // namespace regrasp::repair
