#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/in_blocks.h"
#include "planner/sets/contour/contour_graph.h"
#include "planner/sets/polygon/candidates.h"
#include "planner/sets/polygon/convex_region.h"

namespace regrasp::contour {

/// Find the pieces of candidate pairs, in the order of the candidates, stretching pieces last.
///
/// A piece is empty iff it reaches no side of its rectangle. The differences p_b − p_a of two edges
/// fill an open parallelogram. It does not contain the origin, because edges do not cross. A cone
/// of directions that meets it therefore meets its border. The directions from a vertex to the
/// points of an edge form a cone, too. Signs of cross products therefore decide everything. Doubles
/// with an error bound suffice for full pairs, and for pairs that one border of a cone excludes.
/// Otherwise, intervals and then exact numbers decide. Call it in an IntervalScope.
/// @throws TimeUp  if the deadline is reached.
[[nodiscard]] std::vector<GraspPiece> FindPieces(
    const polygon::EdgeTable& edges, const std::vector<polygon::TwoFingerCandidate>& candidates,
    const Deadline& deadline = {}, const Tell& tell = {});

/// Find the passages between pieces. Call it in an IntervalScope.
///
/// The pieces must be in ascending order of their edges.
/// @throws TimeUp  if the deadline is reached.
[[nodiscard]] std::vector<PiecePassage> FindPassages(const polygon::EdgeTable& edges,
                                                     const Boundary& boundary,
                                                     const std::vector<GraspPiece>& pieces,
                                                     const Deadline& deadline = {},
                                                     const Tell& tell = {});

/// Return the connected sets of pieces.
[[nodiscard]] search::Components FindSets(int piece_count,
                                          const std::vector<PiecePassage>& passages);

/// Return the contacts of a piece on its k-th edge. Call it in an IntervalScope; `edges` must
/// outlive the result.
[[nodiscard]] polygon::FilteredRange PieceRange(const polygon::EdgeTable& edges,
                                                const GraspPiece& piece, int k);

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
