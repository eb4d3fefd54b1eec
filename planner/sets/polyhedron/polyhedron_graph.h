#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/planning/spanning.h"
#include "planner/search/components.h"
#include "planner/search/switching_graph.h"
#include "planner/sets/polyhedron/focus_cells.h"

namespace regrasp::polyhedron {

/// Fingers of the hand: four hold, the fifth switches.
inline constexpr int kPolyhedronFingers = 5;

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
class PolyhedronGraph final : public search::SwitchingGraph {
 public:
  /// @param half_angle  θ, radians.
  /// @throws std::invalid_argument  θ is not in (0, π/2).
  /// @throws TimeUp  the deadline came.
  PolyhedronGraph(const object::Polyhedron& solid, double half_angle, planning::Spanning spanning,
                  const Deadline& deadline = {});

  /// By their faces.
  [[nodiscard]] const std::vector<FocusCell>& cells() const { return cells_; }
  [[nodiscard]] const std::vector<std::array<int, 2>>& links() const { return links_; }
  [[nodiscard]] const FocusCellFinder& finder() const { return finder_; }
  [[nodiscard]] FocusCellFinder& finder() { return finder_; }

  /// Quadruples of faces that pass the test on normals alone, and those with a cell.
  [[nodiscard]] std::int64_t candidate_count() const { return candidates_; }
  [[nodiscard]] std::int64_t combination_count() const { return combinations_; }
  [[nodiscard]] std::int64_t unclear_count() const { return finder_.unclear_count(); }
  [[nodiscard]] search::Components components() const;

  /// Wall time that the vertices and the edges took.
  [[nodiscard]] double vertex_seconds() const { return vertex_seconds_; }
  [[nodiscard]] double edge_seconds() const { return edge_seconds_; }

  [[nodiscard]] int vertex_count() const override { return static_cast<int>(cells_.size()); }
  void GetNeighbours(int vertex, std::vector<int>& neighbours) const override;

 private:
  void FindLinks(const Deadline& deadline);

  FocusCellFinder finder_;
  std::vector<FocusCell> cells_;
  std::vector<std::array<int, 2>> links_;  ///< ascending
  std::vector<std::vector<int>> neighbours_;
  std::int64_t candidates_ = 0;
  std::int64_t combinations_ = 0;
  double vertex_seconds_ = 0;
  double edge_seconds_ = 0;
};

}  // namespace regrasp::polyhedron
