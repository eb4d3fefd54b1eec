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

/// Switching graph of the concurrent grasps of a solid (Phoka 2010, chapter V).
///
/// A vertex is a FocusCell: a connected component of the focus points of four distinct faces with
/// their contacts. An edge connects two cells that overlap and have exactly three common faces.
/// Cones are circular. Cutting planes with certified margins decide. Undecidable cases count as not
/// meeting, and their number is available.
///
/// Laws, except for undecidable cases: the counts do not change if the solid is moved, scaled or
/// mirrored, and do not depend on the order of its triangles. With Spanning::kAdaptive, more
/// friction removes no grasp.
class PolyhedronGraph final : public sets::SetGraph {
 public:
  /// Build the graph; `tell` receives the progress.
  /// @param friction_angle  friction angle θ, rad.
  /// @throws std::invalid_argument  if θ is not in (0, π/2).
  /// @throws TimeUp  if the deadline is reached.
  PolyhedronGraph(const object::Polyhedron& solid, double friction_angle,
                  planning::Spanning spanning, const Deadline& deadline = {},
                  const Tell& tell = {});

  /// Cells, sorted by faces. switches() is ascending.
  [[nodiscard]] const std::vector<FocusCell>& cells() const { return cells_; }
  [[nodiscard]] const FocusCellFinder& finder() const { return finder_; }
  [[nodiscard]] FocusCellFinder& finder() { return finder_; }

  /// Number of quadruples of faces permitted by their normals, and number of those with a cell.
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
