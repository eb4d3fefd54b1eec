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

/// A GraspPiece of a graph; its number in ContourGraph::pieces.
using PieceIndex = Index<struct PieceTag>;
/// A PiecePassage; its number in ContourGraph::passages.
using PassageIndex = Index<struct PassageTag>;

/// The 2-finger grasps of a pair of edges that squeeze or that stretch the object: with
/// v = p_b − p_a, squeezing is v ∈ C(n_a) ∩ −C(n_b), stretching −v. In the contacts' places on the
/// two edges a piece is a convex polygon of at most six corners.
struct GraspPiece {
  std::array<FaceIndex, 2> edges;  ///< ascending
  bool stretching = false;
  /// Every two points of the two edges are such a grasp.
  bool full = false;
  /// Sides of the rectangle of places, {first edge at its begin, at its end, second edge at its
  /// begin, at its end}, that the piece reaches with more than a point.
  std::array<bool, 4> reaches = {};
};

/// Where two pieces meet: one contact goes around a vertex of the polygon while the other stays on
/// its edge, through an open interval of it.
struct PiecePassage {
  std::array<PieceIndex, 2> pieces;  ///< before the vertex and after it
  FaceIndex edge;                    ///< the edge that ends at the vertex, of the first piece
  FaceIndex other;                   ///< the edge of the contact that stays, of both
};

/// Lists of what belongs to each of some owners, one after the other.
template <class Owner, class Member>
struct Grouping {
  std::vector<Member> members;
  std::vector<int> first;  ///< of each owner's members; one more after the last

  [[nodiscard]] std::span<const Member> of(Owner owner) const {
    return {members.begin() + first[owner], members.begin() + first[owner + 1]};
  }
};

/// The switching graph of the 2-finger grasps of a whole boundary, holes included (Phoka 2010,
/// chapter IV).
///
/// A vertex is a connected component of the interior of all graspable sets G(i, j), which go on
/// from one pair of edges to the next across the polygon's vertices; the two fingers are
/// interchangeable, so that a set and its mirror image are one vertex. An edge is a switch: the
/// projections of two sets on the boundary overlap, whichever finger they belong to. What only
/// touches does not meet. All of this is decided exactly for the doubles of the polygon's
/// coordinates and of tan θ.
///
/// Laws: the counts don't change when the polygon is scaled by a power of two, mirrored, turned by
/// 90°, or when its edges are numbered from another vertex; no grasp is lost when θ grows. Cutting
/// an edge in two changes no component and no switch.
class ContourGraph final : public sets::SetGraph {
 public:
  /// @param polygon     must outlive this object.
  /// @param half_angle  θ, radians.
  /// @throws std::invalid_argument  θ is not in (0, π/2).
  /// @throws TimeUp  the deadline came.
  ContourGraph(const object::Polygon& polygon, double half_angle, const Deadline& deadline = {},
               const Tell& tell = {});

  [[nodiscard]] const Boundary& boundary() const { return boundary_; }
  /// tan θ.
  [[nodiscard]] double tangent() const { return tangent_; }

  /// In the order of their edges, squeezing before stretching. switches() is ascending.
  [[nodiscard]] const std::vector<GraspPiece>& pieces() const { return pieces_; }
  [[nodiscard]] const std::vector<PiecePassage>& passages() const { return passages_; }
  /// The vertex that a piece belongs to.
  [[nodiscard]] sets::SetIndex set_of(PieceIndex piece) const { return set_of_[piece]; }
  [[nodiscard]] std::span<const PieceIndex> pieces_of(sets::SetIndex set) const {
    return pieces_by_set_.of(set);
  }
  /// The passages from and to a piece.
  [[nodiscard]] std::span<const PassageIndex> passages_at(PieceIndex piece) const {
    return passages_by_piece_.of(piece);
  }
  /// The pieces on two edges, given in any order: none, one or two.
  [[nodiscard]] std::vector<PieceIndex> PiecesOn(FaceIndex edge, FaceIndex other) const;

  /// Pairs of edges whose normals are within 2θ of opposite, and those with a piece.
  [[nodiscard]] std::int64_t candidate_count() const { return candidates_; }
  [[nodiscard]] std::int64_t combination_count() const { return combinations_; }

 private:
  /// @returns how many sets the pieces are.
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
