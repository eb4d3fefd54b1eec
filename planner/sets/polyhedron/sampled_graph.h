#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/in_blocks.h"
#include "planner/planning/planner.h"
#include "planner/sets/polyhedron/polyhedron_graph.h"

namespace regrasp::polyhedron {

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
