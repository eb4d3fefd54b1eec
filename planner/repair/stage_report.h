#pragma once

#include <cstddef>
#include <string>

#include "planner/base/json.h"

namespace regrasp::repair {

/// Why what a stage made is not the solid that is asked for.
enum class Shortfall {
  kNone,           ///< it is
  kNoResult,       ///< the stage failed
  kNoSolid,        ///< the reader refuses it
  kSeveralSolids,  ///< the reader refuses it for nothing else
  kNotChosen,      ///< of several solids beside each other none was chosen that is there
  kTooFar,         ///< from the original
  kNotAllThere,    ///< too much of it was invented
  kSheet,          ///< the two sides of an open surface
};

/// A stage that was tried.
struct StageReport {
  std::string stage;            ///< its name in reports: "clean", "fill-holes", …
  std::string outcome;          ///< "solid", or why what it made is none
  Json facts = Json::object();  ///< what it did
  std::size_t facets = 0;
  Shortfall shortfall = Shortfall::kNoResult;
  double deviation = 0;  ///< with kTooFar, over the diameter
};

}  // namespace regrasp::repair
