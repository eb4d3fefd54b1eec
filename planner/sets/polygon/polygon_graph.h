#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/in_blocks.h"
#include "planner/object/polygon.h"
#include "planner/sets/polygon/set_cells.h"
#include "planner/sets/set_graph.h"

namespace regrasp::polygon {

/// Switching graph of a polygon (Phoka 2010, chapter III).
///
/// Vertices are GraspSets; an edge is a finger switch between two of them:
/// - concurrent–concurrent: exactly two edges of the polygon are common, and the focus cells
///   overlap.
/// - two-finger–two-finger: always.
/// - two-finger–other: an edge is common, and the projections on its contact parameter overlap.
/// - parallel–parallel: exactly two edges are common, and the projections on their parameters
///   overlap.
/// - concurrent–parallel, only with Spanning::kAdaptive: same as parallel–parallel; or all three
///   edges are common and the sets share grasps, which needs no switch.
///
/// Sets that only touch do not overlap. Every decision is exact for the doubles of the polygon's
/// coordinates and of each set's tangent: interval arithmetic first, then exact numbers.
///
/// Laws: the counts do not change if the polygon is scaled by a power of two, mirrored or rotated
/// by 90°, or if its edges are numbered from another vertex. With Spanning::kAdaptive, more
/// friction removes no grasp.
class PolygonGraph final : public sets::SetGraph {
 public:
  /// Build the graph; `tell` receives the progress.
  /// @param friction_angle  friction angle θ, rad.
  /// @throws std::invalid_argument  if θ is not in (0, π/2).
  /// @throws TimeUp  if the deadline is reached.
  PolygonGraph(const object::Polygon& polygon, double friction_angle, planning::Spanning spanning,
               const Deadline& deadline = {}, const Tell& tell = {});

  /// Sets in the order concurrent, two-finger, parallel; within a type sorted by edges. All
  /// two-finger sets are connected with each other.
  [[nodiscard]] const std::vector<GraspSet>& sets() const { return sets_; }
  [[nodiscard]] const GraspTypeCounts& counts(GraspType type) const {
    return counts_[static_cast<int>(type)];
  }
  /// Number of unordered pairs of connected vertices of two types.
  [[nodiscard]] std::int64_t edge_count(GraspType a, GraspType b) const;
  /// Return the vertices of any type on exactly these edges (ascending).
  [[nodiscard]] std::vector<sets::SetIndex> SetsOn(const std::vector<FaceIndex>& edges) const;

 private:
  [[nodiscard]] std::int64_t CountComponents(GraspType type) const;

  std::vector<GraspSet> sets_;
  std::array<GraspTypeCounts, kGraspTypes> counts_;
};

}  // namespace regrasp::polygon
