#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/in_blocks.h"
#include "planner/planning/plan_request.h"
#include "planner/planning/planner.h"
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

/// Compute a box that contains the focus points of all cells of a graph.
///
/// Its sides move outward until cutting planes prove that no focus point is beyond, in steps that
/// start at 1/1000 of the object's diameter. The box is empty if the graph is empty.
/// @throws TimeUp  if the deadline is reached.
[[nodiscard]] Eigen::AlignedBox3d FindSamplingRegion(const object::Polyhedron& solid,
                                                     PolyhedronGraph& graph,
                                                     const Deadline& deadline = {});

/// Index of a quadruple in a SampledGraph.
using QuadrupleIndex = Index<struct QuadrupleTag>;

/// Part of the switching graph found by random focus points (Phoka 2010, section 5.3.4.2).
///
/// A point adds a quadruple of faces if it sees all four. It adds a link if it sees two quadruples
/// with three common faces, because the contacts on these faces belong to both. Points do not
/// distinguish the components of a cell. A quadruple is therefore one vertex with the links of all
/// its components.
struct SampledGraph {
  std::vector<FaceQuadruple> quadruples;             ///< quadruples in ascending order
  std::vector<std::array<QuadrupleIndex, 2>> links;  ///< links in ascending order
  int components = 0;
};

/// Sample the switching graph with random focus points.
/// @param region  box in which points are drawn uniformly.
/// @param points  number of points.
/// @param seed  seed of the points; the result is deterministic.
/// @throws TimeUp  if the deadline is reached.
[[nodiscard]] SampledGraph SamplePolyhedron(const object::Polyhedron& solid, double friction_angle,
                                            planning::Spanning spanning,
                                            const Eigen::AlignedBox3d& region, int points,
                                            std::uint64_t seed, const Deadline& deadline = {},
                                            const Tell& tell = {});

/// Compute which share of the direct graph the sampling found.
[[nodiscard]] planning::SamplingShare CompareSampling(const SampledGraph& sampled,
                                                      const PolyhedronGraph& graph);

}  // namespace regrasp::polyhedron
