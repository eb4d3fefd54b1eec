#pragma once

#include <optional>
#include <string>

#include "planner/object/weld.h"

namespace regrasp::object {

/// One closed shell of several, with its cavities.
struct LargestShell {
  WeldedSoup soup;   ///< the facets of the others have no corners
  std::string text;  ///< how many were left out, and how large they are
};

/// Finds the closed shell of the largest volume. Shells that meet at an edge are told apart there,
/// so that it does not matter what the others meet. Its cavities are the closed shells inside it
/// that are oriented the other way.
/// @returns nullopt where nothing is to be left out, or a part of the surface is open.
[[nodiscard]] std::optional<LargestShell> FindLargestShell(const WeldedSoup& soup);

}  // namespace regrasp::object
