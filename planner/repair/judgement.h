#pragma once

#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/reading.h"
#include "planner/repair/comparison.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

/// What is to be said against what a stage made.
struct Judgement {
  Shortfall shortfall = Shortfall::kNone;
  std::string complaint;  ///< empty where there is none
  double deviation = 0;   ///< with kTooFar, over the diameter

  [[nodiscard]] bool passes() const { return shortfall == Shortfall::kNone; }
};

/// Whether the reader takes a surface: kNoSolid or kSeveralSolids where not.
/// @param reading  its deadline, and whether several solids beside each other are taken as one body
///                 (Shells::kUnion).
/// @throws TimeUp  the deadline came.
[[nodiscard]] Judgement JudgeSurface(const object::PolygonSoup& soup,
                                     const object::Reading& reading);

/// Whether it is clear which one of several solids is meant; kNotChosen where not.
/// @param volume_shares  of each, largest first.
[[nodiscard]] Judgement JudgeParts(const std::vector<double>& volume_shares,
                                   const object::RepairOptions& options);

/// A surface that is repaired.
struct Original {
  object::PolygonSoup soup;  ///< triangles
  double diameter = 0;
  bool open = false;  ///< an edge has one facet
};

/// Whether a solid is an image of its original: kTooFar, kNotAllThere or kSheet where not. A solid
/// is no sheet where its original is closed: it is as thin as that.
[[nodiscard]] Judgement JudgeShape(const Comparison& comparison, const Original& original,
                                   const object::RepairOptions& options);

}  // namespace regrasp::repair
