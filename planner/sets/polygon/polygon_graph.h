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

/// The switching graph of a polygon (Phoka 2010, chapter III).
///
/// Vertices are GraspSets; an edge is a switch between two of them:
/// - concurrent–concurrent: exactly two edges of the polygon are common, the focus cells overlap;
/// - two-finger–two-finger: always;
/// - two-finger–other: an edge is common and the projections on its contact parameter overlap;
/// - parallel–parallel: exactly two edges are common, the projections on their two parameters
///   overlap;
/// - concurrent–parallel, under Spanning::kAdaptive only: as parallel–parallel; or all three edges
///   are common and the sets share grasps, a join without a switch.
/// What only touches does not overlap. All of this is decided exactly for the doubles of the
/// polygon's coordinates and of each set's tangent: filtered by interval arithmetic, then exact.
///
/// Laws: the counts don't change when the polygon is scaled by a power of two, mirrored, turned by
/// 90° or when its edges are numbered from another vertex; under Spanning::kAdaptive no grasp is
/// lost when the friction grows.
class PolygonGraph final : public sets::SetGraph {
 public:
  /// @param half_angle  θ, radians.
  /// @param tell        told how much of the work is done.
  /// @throws std::invalid_argument  θ is not in (0, π/2).
  /// @throws TimeUp  the deadline came.
  PolygonGraph(const object::Polygon& polygon, double half_angle, planning::Spanning spanning,
               const Deadline& deadline = {}, const Tell& tell = {});

  /// Concurrent sets first, then two-finger, then parallel ones; of each type by their edges. The
  /// two-finger ones are all joined to each other.
  [[nodiscard]] const std::vector<GraspSet>& sets() const { return sets_; }
  [[nodiscard]] const GraspTypeCounts& counts(GraspType type) const {
    return counts_[static_cast<int>(type)];
  }
  /// Unordered pairs of joined vertices of these two types.
  [[nodiscard]] std::int64_t edge_count(GraspType a, GraspType b) const;
  /// The vertices on exactly these edges (ascending), of any type.
  [[nodiscard]] std::vector<sets::SetIndex> SetsOn(const std::vector<FaceIndex>& edges) const;

 private:
  [[nodiscard]] std::int64_t CountComponents(GraspType type) const;

  std::vector<GraspSet> sets_;
  std::array<GraspTypeCounts, kGraspTypes> counts_;
};

}  // namespace regrasp::polygon
