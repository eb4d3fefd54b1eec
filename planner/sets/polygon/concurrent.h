#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "planner/object/polygon.h"
#include "planner/sets/polygon/candidates.h"
#include "planner/sets/polygon/contact_range.h"
#include "planner/sets/polygon/filtered_region.h"
#include "planner/sets/polygon/set_cells.h"

namespace regrasp::polygon {

/// The focus cell of a concurrent set, rounded to doubles for drawing: a convex counter-clockwise
/// polygon for each of the set's parts, in their order.
///
/// At φ = φ* a cell may reach infinity; what is farther than `kFarthestFocus` diameters from the
/// centroid is cut off.
[[nodiscard]] std::vector<std::vector<Eigen::Vector2d>> FocusCell(const object::Polygon& polygon,
                                                                  const GraspSet& set);

inline constexpr double kFarthestFocus = 100;  ///< over D

/// The focus points of one part of a concurrent set: those on fixed sides of its edges' lines.
struct FocusPart {
  int sides;  ///< bit k is set iff they lie on the outer side of the k-th edge
  FilteredRegion region;
};

/// A connected component of a focus cell.
struct FocusComponent {
  std::vector<FocusPart> parts;  ///< by `sides`
};

/// Of a focus point: it lies on either side of each of three edges' lines.
inline constexpr int kSidePatterns = 8;

/// Finds focus cells. Inside an IntervalScope; the edges must outlive the finder and its cells.
class ConcurrentCellFinder {
 public:
  explicit ConcurrentCellFinder(const EdgeTable& edges) : edges_(edges) {}

  /// The components of the focus cell F(i,j,k) (Phoka 2010, Def. 3.7): points from which each of
  /// the three edges is seen inside its double-sided cone.
  ///
  /// What sees an edge is a convex region on either side of its line, and the two are joined
  /// through the open edge. So the cell is a union of at most eight convex parts, and two parts
  /// that differ in one side are one component iff they share a segment of that edge. Candidates
  /// that come in lexicographic order share what sees their first two edges.
  [[nodiscard]] std::vector<FocusComponent> Find(const ConcurrentCandidate& candidate);

 private:
  using Parts = std::array<std::optional<FilteredRegion>, kSidePatterns>;

  void SeeFirstTwo(const ConcurrentCandidate& candidate);
  Parts MakeParts(const ConcurrentCandidate& candidate);

  const EdgeTable& edges_;
  TwoFingerCandidate first_two_;
  double tangent_ = 0;
  /// What sees the first two edges, by the sides; nullopt where intervals cannot tell.
  std::array<std::optional<ConvexRegion<Interval>>, kSidePatterns / 2> seeing_two_;
};

/// True iff two components have focus points in common.
/// @param common  the positions of the edges that both have: in the first, in the second.
[[nodiscard]] bool FocusCellsOverlap(const FocusComponent& a, const FocusComponent& b,
                                     std::span<const std::pair<int, int>> common);

/// The contacts on the k-th edge that are seen from a component.
[[nodiscard]] FilteredRange FocusContactRange(const EdgeTable& edges,
                                              const ConcurrentCandidate& candidate,
                                              const FocusComponent& component, int k);

/// The pairs of contacts on the k-th and l-th edge (k < l) that are seen together from one point of
/// the component, one region of [0, 1]² per part.
///
/// Two cones at moving contacts and the region that sees the third edge have a common interior iff
/// every three of their half-planes have (Helly). Those of three normals that balance with weights
/// λ > 0 meet iff the weighted sum of their offsets is positive, which is linear in the contacts.
[[nodiscard]] std::vector<FilteredRegion> FocusContactPairs(const EdgeTable& edges,
                                                            const ConcurrentCandidate& candidate,
                                                            const FocusComponent& component, int k,
                                                            int l);

}  // namespace regrasp::polygon
