#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner/base/index.h"
#include "planner/sets/polyhedron/min_max.h"
#include "planner/sets/polyhedron/normal_quadruples.h"

namespace regrasp::polyhedron {

/// Index of a half of the union volume of a face's part or hull: 2 · part, or 2 · part + 1 for the
/// outer side. Hulls are numbered after all parts.
using HalfIndex = Index<struct HalfTag>;
[[nodiscard]] constexpr HalfIndex HalfOf(PartIndex part, bool inner) {
  return HalfIndex(2 * part + (inner ? 0 : 1));
}
[[nodiscard]] constexpr PartIndex PartNumber(HalfIndex half) { return PartIndex(half / 2); }
[[nodiscard]] constexpr bool IsInner(HalfIndex half) { return half % 2 == 0; }

/// One half for each of four faces, in the order of the faces.
using Halves = std::array<HalfIndex, 4>;

/// Convex piece of a focus cell: focus points on a fixed side of each face that see a contact of a
/// fixed convex part of it.
struct FocusPiece {
  Halves halves;          ///< halves of parts
  Eigen::Vector3d point;  ///< focus point inside the piece
  MinMax::Basis basis;    ///< basis for a warm start
};

/// Vertex of the switching graph: a connected component of the focus points of four faces together
/// with their contacts (Phoka 2010, definition 5.5).
struct FocusCell {
  FaceQuadruple faces;
  double tangent = 0;  ///< tan φ of its cones
  std::vector<FocusPiece> pieces;
};

/// Return the position of a face in a cell, 4 if the cell does not have it.
[[nodiscard]] std::size_t PositionOf(const FocusCell& cell, FaceIndex face);
/// Return the position of the only face of a cell that a second cell does not have.
[[nodiscard]] std::size_t OwnPosition(const FocusCell& cell, const FocusCell& other);

/// Finds the focus cells of a solid, and decides whether two of them overlap.
class FocusCellFinder {
 public:
  /// @param solid  must outlive this object.
  /// @param tangent  tan θ, with θ the friction angle.
  FocusCellFinder(const object::Polyhedron& solid, double tangent);

  /// Find the components of the focus cell of a candidate; empty if the cell has no interior.
  [[nodiscard]] std::vector<FocusCell> Find(const QuadrupleCandidate& candidate);

  /// Return whether two cells with exactly three common faces have a common focus point that sees
  /// common contacts on these faces.
  [[nodiscard]] bool Overlap(const FocusCell& a, const FocusCell& b);

  /// Number of decisions that doubles could not make. Such sets count as touching, which is not
  /// meeting. Decisions at a vertex or edge shared by two of the faces are not counted: the sets
  /// touch there by construction.
  [[nodiscard]] std::int64_t unclear_count() const { return unclear_; }

  /// Grasp at which two pieces of a cell that differ in one half meet. Its focus point is on the
  /// face between them, or its contact is on the joint of two parts.
  struct Junction {
    Eigen::Vector3d focus;
    std::size_t changed;      ///< position of the face with different halves
    Eigen::Vector3d contact;  ///< contact on that face
  };
  /// Find a junction of two pieces; nullopt if they do not meet.
  /// @param until  kSign: any junction; kMinimum: the one with the focus point deepest inside.
  [[nodiscard]] std::optional<Junction> FindJunction(double tangent, const FocusPiece& a,
                                                     const FocusPiece& b,
                                                     MinMax::Until until = MinMax::Until::kMinimum);

  /// Find the focus point deepest inside some volumes; nullopt if they have no common interior.
  /// @param from  a piece whose volumes are among them, for a warm start.
  [[nodiscard]] std::optional<MinMaxResult> FindDeepest(std::span<const UnionVolume> volumes,
                                                        const FocusPiece* from = nullptr);

  /// Return whether the maximum of some convex functions is negative at some point.
  [[nodiscard]] bool HasPoint(const MinMax::LargestCut& largest_cut);

  [[nodiscard]] const FaceParts& parts() const { return parts_; }
  /// Part of a face, or its hull, to which a half belongs.
  [[nodiscard]] const FacePart& PartOf(HalfIndex half) const {
    const std::size_t part = PartNumber(half);
    const std::size_t parts = parts_.parts.size();
    return part < parts ? parts_.parts[part] : parts_.hulls[part - parts];
  }
  [[nodiscard]] UnionVolume VolumeOf(HalfIndex half, double tangent) const {
    return {PartOf(half), IsInner(half), tangent};
  }
  [[nodiscard]] std::vector<UnionVolume> VolumesOf(const FocusPiece& piece, double tangent) const;

 private:
  enum class Known : std::uint8_t { kNo, kYes, kNotYet };

  [[nodiscard]] bool MayMeet(HalfIndex half, HalfIndex other);
  [[nodiscard]] std::vector<int> SharedCorners(HalfIndex half, HalfIndex other) const;
  void FindPieces(const QuadrupleCandidate& candidate, std::size_t depth, Halves& halves,
                  std::vector<FocusPiece>& pieces);
  void Refine(const QuadrupleCandidate& candidate, std::size_t position, const FocusPiece& piece,
              std::vector<FocusPiece>& pieces);
  [[nodiscard]] MinMaxResult MeetAcrossFace(double tangent, const FocusPiece& a,
                                            std::size_t changed, MinMax::Until until);
  [[nodiscard]] std::optional<Eigen::Vector3d> MeetOverJoint(double tangent, const FocusPiece& a,
                                                             const FocusPiece& b,
                                                             std::size_t changed,
                                                             const FacePart& segment,
                                                             MinMax::Until until);
  [[nodiscard]] bool Decide(const MinMaxResult& result, std::span<const HalfIndex> halves);
  [[nodiscard]] bool IsAtSharedBorder(const Eigen::Vector3d& point,
                                      std::span<const HalfIndex> halves) const;

  /// Joint of a part with another part.
  struct JoinedPart {
    PartIndex other;
    int joint;
  };

  const object::Polyhedron& solid_;
  FaceParts parts_;
  std::vector<std::vector<JoinedPart>> joined_;  ///< joints of each part
  double tangent_;
  MinMax min_max_;
  std::vector<Known> meet_;  ///< results of MayMeet by pairs of halves of hulls
  std::int64_t unclear_ = 0;
};

}  // namespace regrasp::polyhedron
