#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/in_blocks.h"
#include "planner/planning/plan_request.h"
#include "planner/sets/polyhedron/focus_cells.h"
#include "planner/sets/set_graph.h"

namespace regrasp::polyhedron {

/// The switching graph of the concurrent grasps of a solid (Phoka 2010, chapter V).
///
/// A vertex is a FocusCell: a connected component of the focus points of four distinct faces, with
/// their contacts; an edge joins two whose faces are the same but for one and that overlap. Cones
/// are circular. Decided by cutting planes with certified margins; what is too close to call counts
/// as not meeting, and is counted.
///
/// Laws: the counts don't change when the solid is moved, scaled or mirrored, nor with the order of
/// its facets, as far as nothing is too close to call; under Spanning::kAdaptive no grasp is lost
/// when the friction grows.
class PolyhedronGraph final : public sets::SetGraph {
 public:
  /// @param half_angle  θ, radians.
  /// @param tell        told how much of the work is done.
  /// @throws std::invalid_argument  θ is not in (0, π/2).
  /// @throws TimeUp  the deadline came.
  PolyhedronGraph(const object::Polyhedron& solid, double half_angle, planning::Spanning spanning,
                  const Deadline& deadline = {}, const Tell& tell = {});

  /// By their faces. switches() is ascending.
  [[nodiscard]] const std::vector<FocusCell>& cells() const { return cells_; }
  [[nodiscard]] const FocusCellFinder& finder() const { return finder_; }
  [[nodiscard]] FocusCellFinder& finder() { return finder_; }

  /// Quadruples of faces that pass the test on normals alone, and those with a cell.
  [[nodiscard]] std::int64_t candidate_count() const { return candidates_; }
  [[nodiscard]] std::int64_t combination_count() const { return combinations_; }
  [[nodiscard]] std::int64_t unclear_count() const { return finder_.unclear_count(); }

 private:
  [[nodiscard]] std::vector<sets::SetPair> FindSwitches(const Deadline& deadline, const Tell& tell);

  FocusCellFinder finder_;
  std::vector<FocusCell> cells_;
  std::int64_t candidates_ = 0;
  std::int64_t combinations_ = 0;
};

}  // namespace regrasp::polyhedron
