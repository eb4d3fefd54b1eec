#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/in_blocks.h"
#include "planner/object/polygon.h"
#include "planner/sets/contour/boundary.h"
#include "planner/sets/set_graph.h"

namespace regrasp::contour {

/// Index of a GraspPiece in ContourGraph::pieces.
using PieceIndex = Index<struct PieceTag>;
/// Index of a PiecePassage in ContourGraph::passages.
using PassageIndex = Index<struct PassageTag>;

/// 2-finger grasps of a pair of edges, either from outside or stretching from inside.
///
/// With v = p_b − p_a, a grasp from outside has v ∈ C(n_a) ∩ −C(n_b), a stretching one −v. In the
/// places of the contacts on the two edges, a piece is a convex polygon of at most six corners.
struct GraspPiece {
  std::array<FaceIndex, 2> edges;  ///< edges in ascending order
  bool stretching = false;
  /// Whether every two points of the two edges are such a grasp.
  bool full = false;
  /// Whether the piece reaches each side of the rectangle of places in more than a point. Order:
  /// start and end of the first edge, start and end of the second edge.
  std::array<bool, 4> reaches = {};
};

/// Connection of two pieces: one contact passes a vertex of the polygon, and the other contact
/// stays on its edge, inside an open interval.
struct PiecePassage {
  std::array<PieceIndex, 2> pieces;  ///< pieces before and after the vertex
  FaceIndex edge;                    ///< edge of the first piece that ends at the vertex
  FaceIndex other;                   ///< edge of the fixed contact, in both pieces
};

/// Lists of the members of each owner, stored consecutively.
template <class Owner, class Member>
struct Grouping {
  std::vector<Member> members;
  std::vector<int> first;  ///< index of the first member of each owner, and the end

  [[nodiscard]] std::span<const Member> of(Owner owner) const {
    return {members.begin() + first[owner], members.begin() + first[owner + 1]};
  }
};

/// Switching graph of the 2-finger grasps of a whole boundary, including holes (Phoka 2010, chapter
/// IV).
///
/// A vertex is a connected component of the interior of all graspable sets G(i, j). These sets
/// continue from one pair of edges to the next across the polygon's vertices. The two fingers are
/// interchangeable, so a set and its mirror image are one vertex. An edge is a finger switch: the
/// projections of two sets on the boundary overlap, for any fingers. Sets that only touch do not
/// meet. Every decision is exact for the doubles of the polygon's coordinates and of tan θ.
///
/// Laws: the counts do not change if the polygon is scaled by a power of two, mirrored or rotated
/// by 90°, or if its edges are numbered from another vertex. A larger θ removes no grasp. Splitting
/// an edge changes no component and no switch.
class ContourGraph final : public sets::SetGraph {
 public:
  /// @param polygon     must outlive this object.
  /// @param friction_angle  friction angle θ, rad.
  /// @throws std::invalid_argument  if θ is not in (0, π/2).
  /// @throws TimeUp  if the deadline is reached.
  ContourGraph(const object::Polygon& polygon, double friction_angle, const Deadline& deadline = {},
               const Tell& tell = {});

  [[nodiscard]] const Boundary& boundary() const { return boundary_; }
  /// Tangent of the friction angle θ.
  [[nodiscard]] double tangent() const { return tangent_; }

  /// Pieces in the order of their edges, on equal edges stretching last. switches() is ascending.
  [[nodiscard]] const std::vector<GraspPiece>& pieces() const { return pieces_; }
  [[nodiscard]] const std::vector<PiecePassage>& passages() const { return passages_; }
  /// Vertex to which a piece belongs.
  [[nodiscard]] sets::SetIndex set_of(PieceIndex piece) const { return set_of_[piece]; }
  [[nodiscard]] std::span<const PieceIndex> pieces_of(sets::SetIndex set) const {
    return pieces_by_set_.of(set);
  }
  /// Passages from and to a piece.
  [[nodiscard]] std::span<const PassageIndex> passages_at(PieceIndex piece) const {
    return passages_by_piece_.of(piece);
  }
  /// Return the pieces on two edges in any order: none, one or two.
  [[nodiscard]] std::vector<PieceIndex> PiecesOn(FaceIndex edge, FaceIndex other) const;

  /// Number of pairs of edges with normals within 2θ of opposite, and number of those with a piece.
  [[nodiscard]] std::int64_t candidate_count() const { return candidates_; }
  [[nodiscard]] std::int64_t combination_count() const { return combinations_; }

 private:
  /// Group the pieces into sets. @returns number of sets.
  int GroupPieces();

  Boundary boundary_;
  double tangent_;
  std::vector<GraspPiece> pieces_;
  std::vector<PiecePassage> passages_;
  std::vector<sets::SetIndex> set_of_;
  Grouping<sets::SetIndex, PieceIndex> pieces_by_set_;
  Grouping<PieceIndex, PassageIndex> passages_by_piece_;
  std::int64_t candidates_ = 0;
  std::int64_t combinations_ = 0;
};

}  // namespace regrasp::contour
