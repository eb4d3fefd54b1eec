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

/// Pairs of sets whose projections on the boundary overlap (Phoka 2010, section 4.5), ascending.
///
/// A sweep along the boundary, over where the projections begin and end, in the exact order of
/// these places: by edge, then by contact parameter. O(m log m + k), k being the number of overlaps
/// of m intervals. Inside an IntervalScope.
/// @param pieces_of  the pieces of a set.
/// @throws TimeUp  the deadline came.
[[nodiscard]] std::vector<sets::SetPair> FindOverlaps(
    const polygon::EdgeTable& edges, const Boundary& boundary,
    const std::vector<GraspPiece>& pieces, int set_count,
    const std::function<std::span<const PieceIndex>(sets::SetIndex set)>& pieces_of,
    const Deadline& deadline = {}, const Tell& tell = {});

}  // namespace regrasp::contour
