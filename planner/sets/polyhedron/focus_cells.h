#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner/sets/polyhedron/min_max.h"
#include "planner/sets/polyhedron/normal_quadruples.h"

namespace regrasp::polyhedron {

/// A convex piece of a focus cell: focus points on a fixed side of each face that see a contact of
/// a fixed convex part of it.
struct FocusPiece {
  /// Half of a part's union volume, one of each face in the faces' order: 2 · part, or 2 · part + 1
  /// for the outer side.
  std::array<int, 4> halves;
  Eigen::Vector3d point;  ///< a focus point inside
  MinMax::Basis basis;    ///< to go on from
};

/// A vertex of the switching graph: a connected component of the focus points of four faces
/// together with their contacts (Phoka 2010, definition 5.5).
struct FocusCell {
  std::array<int, 4> faces;  ///< ascending
  double tangent = 0;        ///< tan φ
  std::vector<FocusPiece> pieces;
};

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
  [[nodiscard]] std::optional<Junction> FindJunction(double tangent, const FocusPiece& a,
                                                     const FocusPiece& b);

  /// The focus point deepest inside some volumes; nullopt where they have none in common.
  /// @param from  a piece whose volumes are among them, to go on from what is known of it.
  [[nodiscard]] std::optional<MinMaxResult> FindDeepest(std::span<const UnionVolume> volumes,
                                                        const FocusPiece* from = nullptr);

  /// Whether the largest of some convex functions is negative somewhere.
  [[nodiscard]] bool HasPoint(const MinMax::LargestCut& largest_cut);

  [[nodiscard]] const FaceParts& parts() const { return parts_; }
  [[nodiscard]] const UnionVolume::Shape& ShapeOf(int half) const { return shapes_[half / 2]; }
  [[nodiscard]] UnionVolume VolumeOf(int half, double tangent) const {
    return {shapes_[half / 2], half % 2 == 0, tangent};
  }

 private:
  enum class Known : std::uint8_t { kNo, kYes, kNotYet };

  [[nodiscard]] bool MayMeet(int half, int other);
  [[nodiscard]] const FacePart& PartOf(int half) const;
  [[nodiscard]] std::vector<int> SharedCorners(int half, int other) const;
  void FindPieces(const QuadrupleCandidate& candidate, std::size_t depth,
                  std::array<int, 4>& halves, std::vector<FocusPiece>& pieces);
  void Refine(const QuadrupleCandidate& candidate, std::size_t position, const FocusPiece& piece,
              std::vector<FocusPiece>& pieces);
  [[nodiscard]] std::vector<UnionVolume> VolumesOf(const FocusPiece& piece, double tangent) const;
  [[nodiscard]] bool AreJoined(double tangent, const FocusPiece& a, const FocusPiece& b);
  [[nodiscard]] MinMaxResult MeetAcrossFace(double tangent, const FocusPiece& a,
                                            std::size_t changed, MinMax::Until until);
  [[nodiscard]] bool Decide(const MinMaxResult& result, std::span<const int> halves);
  [[nodiscard]] bool IsAtSharedBorder(const Eigen::Vector3d& point,
                                      std::span<const int> halves) const;

  /// A joint as one of its parts sees it.
  struct JoinedPart {
    int other;  ///< part
    int joint;
  };

  const object::Polyhedron& solid_;
  FaceParts parts_;
  std::vector<UnionVolume::Shape> shapes_;        ///< of the parts, then of the hulls
  std::vector<UnionVolume::Shape> joint_shapes_;  ///< segments
  std::vector<std::vector<JoinedPart>> joined_;   ///< by parts
  double tangent_;
  MinMax min_max_;
  std::vector<Known> meet_;  ///< by pairs of halves of faces' hulls
  std::int64_t unclear_ = 0;
};

}  // namespace regrasp::polyhedron
