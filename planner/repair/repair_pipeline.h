#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/object/polygon_soup.h"
#include "planner/repair/comparison.h"
#include "planner/repair/repair.h"
#include "planner/repair/stages.h"

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

/// Verdict on the result of a stage.
struct Judgement {
  Shortfall shortfall = Shortfall::kNone;
  std::string complaint;  ///< reason of rejection; empty if accepted
  double deviation = 0;   ///< deviation over the diameter; set with kTooFar

  [[nodiscard]] bool passes() const { return shortfall == Shortfall::kNone; }
};

/// Check whether the reader accepts a surface.
/// @param reading  the deadline, and whether several separate solids count as one object
///     (Shells::kUnion).
/// @returns kNone, kNoSolid or kSeveralSolids.
/// @throws TimeUp  if the deadline passes.
[[nodiscard]] Judgement JudgeSurface(const object::PolygonSoup& soup,
                                     const object::Reading& reading);

/// Check whether the options determine which one of several solids is used.
/// @param volume_shares  volume of each solid over the sum, largest first.
/// @returns kNone or kNotChosen.
[[nodiscard]] Judgement JudgeParts(const std::vector<double>& volume_shares,
                                   const object::RepairOptions& options);

/// Surface before the repair.
struct Original {
  object::PolygonSoup soup;  ///< triangles
  double diameter = 0;
  bool open = false;  ///< whether an edge has one triangle only
};

/// Check whether a solid represents its original.
/// A solid of a closed original is never rejected as a sheet, because the original is equally thin.
/// @returns kNone, kTooFar, kNotAllThere or kSheet.
[[nodiscard]] Judgement JudgeShape(const Comparison& comparison, const Original& original,
                                   const object::RepairOptions& options);

}  // namespace regrasp::repair
