#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "planner/object/polygon.h"
#include "planner/sets/polygon/candidates.h"
#include "planner/sets/polygon/convex_region.h"
#include "planner/sets/polygon/set_cells.h"

namespace regrasp::polygon {

/// Compute the focus cell of a concurrent set, rounded to doubles for drawing.
///
/// At φ = φ* a cell may be unbounded. It is clipped at `kFarthestFocus` diameters from the
/// centroid.
/// @returns for each part of the set, in order, a convex counter-clockwise polygon.
[[nodiscard]] std::vector<std::vector<Eigen::Vector2d>> FocusCell(const object::Polygon& polygon,
                                                                  const GraspSet& set);

inline constexpr double kFarthestFocus = 100;  ///< divided by D

/// Focus points of one part of a concurrent set: those on fixed sides of its edges' lines.
struct FocusPart {
  int sides;  ///< bit k is set iff they are on the outer side of the k-th edge
  FilteredRegion region;
};

/// Connected component of a focus cell.
struct FocusComponent {
  std::vector<FocusPart> parts;  ///< parts, sorted by `sides`
};

/// Number of combinations of sides of three edges' lines on which a focus point can be.
inline constexpr int kSidePatterns = 8;

/// Finds focus cells. Use it in an IntervalScope; the edges must outlive the finder and its cells.
class ConcurrentCellFinder {
 public:
  explicit ConcurrentCellFinder(const EdgeTable& edges) : edges_(edges) {}

  /// Find the components of the focus cell F(i,j,k) (Phoka 2010, Def. 3.7).
  ///
  /// The cell contains the points that see each of the three edges inside its double-sided cone.
  /// The points that see an edge form a convex region on either side of its line, connected through
  /// the open edge. The cell is therefore a union of at most eight convex parts. Two parts that
  /// differ in one side are connected iff they share a segment of that edge. Consecutive candidates
  /// in lexicographic order share the region of their first two edges.
  [[nodiscard]] std::vector<FocusComponent> Find(const ConcurrentCandidate& candidate);

 private:
  using Parts = std::array<std::optional<FilteredRegion>, kSidePatterns>;

  void SeeFirstTwo(const ConcurrentCandidate& candidate);
  Parts MakeParts(const ConcurrentCandidate& candidate);

  const EdgeTable& edges_;
  TwoFingerCandidate first_two_;
  double tangent_ = 0;
  /// Regions that see the first two edges, by sides; nullopt if intervals cannot decide.
  std::array<std::optional<ConvexRegion<Interval>>, kSidePatterns / 2> seeing_two_;
};

/// Return whether two components have common focus points.
/// @param common  positions of the common edges: in the first and in the second component.
[[nodiscard]] bool FocusCellsOverlap(const FocusComponent& a, const FocusComponent& b,
                                     std::span<const std::pair<int, int>> common);

/// Return the contacts on the k-th edge that a component sees.
[[nodiscard]] FilteredRange FocusContactRange(const EdgeTable& edges,
                                              const ConcurrentCandidate& candidate,
                                              const FocusComponent& component, int k);

/// Return the pairs of contacts on the k-th and l-th edge (k < l) that one point of the component
/// sees.
///
/// There is one region of [0, 1]² per part. Two cones at moving contacts and the region that sees
/// the third edge have a common interior iff every three of their half-planes have (Helly).
/// Consider three half-planes whose normals balance with weights λ > 0. They intersect iff the
/// weighted sum of their offsets is positive, which is linear in the contacts.
[[nodiscard]] std::vector<FilteredRegion> FocusContactPairs(const EdgeTable& edges,
                                                            const ConcurrentCandidate& candidate,
                                                            const FocusComponent& component, int k,
                                                            int l);

}  // namespace regrasp::polygon
