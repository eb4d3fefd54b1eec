#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/in_blocks.h"
#include "planner/base/index.h"
#include "planner/grasp/contact.h"
#include "planner/object/polygon.h"
#include "planner/sets/set_graph.h"

namespace regrasp::contour {

/// Index of a ring of a polygon: 0 for the outline, otherwise a hole.
using RingIndex = Index<struct RingTag>;

/// Parametrization of a polygon's boundary by length.
///
/// A place on a ring is the length along the ring's edges (material on the left) from its first
/// vertex. It is periodic in the ring's perimeter. Lengths are in object units.
class Boundary {
 public:
  /// @param polygon  must outlive this object.
  explicit Boundary(const object::Polygon& polygon);

  [[nodiscard]] const object::Polygon& polygon() const { return polygon_; }

  [[nodiscard]] int edge_count() const { return static_cast<int>(ring_of_.size()); }
  [[nodiscard]] int ring_count() const { return static_cast<int>(perimeters_.size()); }
  [[nodiscard]] RingIndex ring_of(FaceIndex edge) const { return ring_of_[edge]; }
  /// Range of the edges of a ring: first_edge(ring), inclusive, to end_edge(ring), exclusive.
  [[nodiscard]] FaceIndex first_edge(RingIndex ring) const { return first_edges_[ring]; }
  [[nodiscard]] FaceIndex end_edge(RingIndex ring) const { return first_edges_[ring + 1]; }
  [[nodiscard]] double perimeter(RingIndex ring) const { return perimeters_[ring]; }

  /// Edge that starts at the end of this one.
  [[nodiscard]] FaceIndex next(FaceIndex edge) const { return next_[edge]; }

  /// Places of the start and the end of an edge on its ring; end > begin.
  [[nodiscard]] double begin(FaceIndex edge) const { return begins_[edge]; }
  [[nodiscard]] double end(FaceIndex edge) const { return ends_[edge]; }

  /// Return the place of a contact whose face is set.
  [[nodiscard]] double PlaceOf(const grasp::Contact& contact) const;

  /// Return the contact on an edge at a place, which is clamped to begin(edge) … end(edge).
  [[nodiscard]] grasp::Contact ContactAt(FaceIndex edge, double place) const;

 private:
  const object::Polygon& polygon_;
  std::vector<RingIndex> ring_of_;
  std::vector<FaceIndex> first_edges_;
  std::vector<double> perimeters_;
  std::vector<FaceIndex> next_;
  std::vector<double> begins_;
  std::vector<double> ends_;
};

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
