#pragma once

#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/in_blocks.h"
#include "planner/sets/contour/contour_graph.h"
#include "planner/sets/polygon/candidates.h"
#include "planner/sets/polygon/contact_range.h"

namespace regrasp::contour {

/// The pieces of the candidate pairs, in the order of the candidates, squeezing before stretching.
///
/// A piece is empty iff it reaches no side of its rectangle: the differences p_b − p_a of two edges
/// fill an open parallelogram that does not contain the origin, as edges don't cross, so that a
/// cone of directions which meets it meets its border. What a side sees is a cone of directions
/// too, from a vertex to an edge, so that all of this is decided by signs of cross products: with
/// doubles and an error bound for pairs that are full or that one border of a cone excludes,
/// otherwise by intervals, then exactly. Inside an IntervalScope.
/// @throws TimeUp  the deadline came.
[[nodiscard]] std::vector<GraspPiece> FindPieces(
    const polygon::EdgeTable& edges, const std::vector<polygon::TwoFingerCandidate>& candidates,
    const Deadline& deadline = {}, const Tell& tell = {});

/// The passages between pieces, which are in ascending order of their edges. Inside an
/// IntervalScope.
/// @throws TimeUp  the deadline came.
[[nodiscard]] std::vector<PiecePassage> FindPassages(const polygon::EdgeTable& edges,
                                                     const Boundary& boundary,
                                                     const std::vector<GraspPiece>& pieces,
                                                     const Deadline& deadline = {},
                                                     const Tell& tell = {});

/// The sets that pieces are by their passages.
[[nodiscard]] search::Components FindSets(int piece_count,
                                          const std::vector<PiecePassage>& passages);

/// The contacts of a piece on its k-th edge. `edges` must outlive the result; inside an
/// IntervalScope.
[[nodiscard]] polygon::FilteredRange PieceRange(const polygon::EdgeTable& edges,
                                                const GraspPiece& piece, int k);

}  // namespace regrasp::contour
