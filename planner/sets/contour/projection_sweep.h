#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/in_blocks.h"
#include "planner/sets/contour/contour_graph.h"
#include "planner/sets/polygon/candidates.h"

namespace regrasp::contour {

/// Find the pairs of sets whose projections on the boundary overlap (Phoka 2010, section 4.5), in
/// ascending order.
///
/// The method is a sweep along the boundary over the ends of the projections. Their order is exact:
/// by edge, then by contact parameter. It takes O(m log m + k) for m intervals with k overlaps.
/// Call it in an IntervalScope.
/// @param pieces_of  function that returns the pieces of a set.
/// @throws TimeUp  if the deadline is reached.
[[nodiscard]] std::vector<sets::SetPair> FindOverlaps(
    const polygon::EdgeTable& edges, const Boundary& boundary,
    const std::vector<GraspPiece>& pieces, int set_count,
    const std::function<std::span<const PieceIndex>(sets::SetIndex set)>& pieces_of,
    const Deadline& deadline = {}, const Tell& tell = {});

}  // namespace regrasp::contour
