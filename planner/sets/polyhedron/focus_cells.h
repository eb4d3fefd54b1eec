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

/// Half of the union volume of a convex part of a face, or of a face's hull: 2 · part, or
/// 2 · part + 1 for the outer side. Hulls are numbered after all parts.
using HalfIndex = Index<struct HalfTag>;
[[nodiscard]] constexpr HalfIndex HalfOf(PartIndex part, bool inner) {
  return HalfIndex(2 * part + (inner ? 0 : 1));
}
[[nodiscard]] constexpr PartIndex PartNumber(HalfIndex half) { return PartIndex(half / 2); }
[[nodiscard]] constexpr bool IsInner(HalfIndex half) { return half % 2 == 0; }

/// One of each of four faces, in the faces' order.
using Halves = std::array<HalfIndex, 4>;

/// A convex piece of a focus cell: focus points on a fixed side of each face that see a contact of
/// a fixed convex part of it.
struct FocusPiece {
  Halves halves;          ///< of parts
  Eigen::Vector3d point;  ///< a focus point inside
  MinMax::Basis basis;    ///< to go on from
};

/// A vertex of the switching graph: a connected component of the focus points of four faces
/// together with their contacts (Phoka 2010, definition 5.5).
struct FocusCell {
  FaceQuadruple faces;
  double tangent = 0;  ///< tan φ
  std::vector<FocusPiece> pieces;
};

/// The position of a face among a cell's, 4 where it has another.
[[nodiscard]] std::size_t PositionOf(const FocusCell& cell, FaceIndex face);
/// That of the only face of a cell that the other one does not have.
[[nodiscard]] std::size_t OwnPosition(const FocusCell& cell, const FocusCell& other);

/// Finds the focus cells of a solid, and which of them overlap.
class FocusCellFinder {
 public:
  /// @param tangent  tan θ. `solid` must outlive this object.
  FocusCellFinder(const object::Polyhedron& solid, double tangent);

  /// The components of the focus cell of a candidate; empty where it has no interior.
  [[nodiscard]] std::vector<FocusCell> Find(const QuadrupleCandidate& candidate);

  /// Whether two cells with exactly three common faces have a focus point in common, with contacts
  /// on the common faces in common.
  [[nodiscard]] bool Overlap(const FocusCell& a, const FocusCell& b);

  /// Decisions that doubles could not make; the sets then count as touching, which is not meeting.
  /// Not those at a vertex or an edge of the solid that two of the faces share: there they touch by
  /// construction.
  [[nodiscard]] std::int64_t unclear_count() const { return unclear_; }

  /// Where two pieces of a cell that differ in one half meet: a grasp whose focus point lies on the
  /// face that it passes, or whose contact lies on the joint between two parts.
  struct Junction {
    Eigen::Vector3d focus;
    std::size_t changed;      ///< the position of the face whose half differs
    Eigen::Vector3d contact;  ///< on it
  };
  /// @param until  kSign: any such grasp; otherwise the one whose focus point is deepest inside.
  [[nodiscard]] std::optional<Junction> FindJunction(double tangent, const FocusPiece& a,
                                                     const FocusPiece& b,
                                                     MinMax::Until until = MinMax::Until::kMinimum);

  /// The focus point deepest inside some volumes; nullopt where they have none in common.
  /// @param from  a piece whose volumes are among them, to go on from what is known of it.
  [[nodiscard]] std::optional<MinMaxResult> FindDeepest(std::span<const UnionVolume> volumes,
                                                        const FocusPiece* from = nullptr);

  /// Whether the largest of some convex functions is negative somewhere.
  [[nodiscard]] bool HasPoint(const MinMax::LargestCut& largest_cut);

  [[nodiscard]] const FaceParts& parts() const { return parts_; }
  /// The part of a face, or its hull, that a half belongs to.
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

  /// A joint as one of its parts sees it.
  struct JoinedPart {
    PartIndex other;
    int joint;
  };

  const object::Polyhedron& solid_;
  FaceParts parts_;
  std::vector<std::vector<JoinedPart>> joined_;  ///< by parts
  double tangent_;
  MinMax min_max_;
  std::vector<Known> meet_;  ///< by pairs of halves of faces' hulls
  std::int64_t unclear_ = 0;
};

}  // namespace regrasp::polyhedron
