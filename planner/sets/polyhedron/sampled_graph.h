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

/// A box that contains the focus points of all cells of a graph. Its sides are bounds by cutting
/// planes of the cells' own intersections, within a thousandth of its size; empty where the graph
/// is.
/// @throws TimeUp  the deadline came.
[[nodiscard]] Eigen::AlignedBox3d FindSamplingRegion(const object::Polyhedron& solid,
                                                     PolyhedronGraph& graph,
                                                     const Deadline& deadline = {});

/// A quadruple of a SampledGraph.
using QuadrupleIndex = Index<struct QuadrupleTag>;

/// What random focus points find of the switching graph (Phoka 2010, section 5.3.4.2): a quadruple
/// of faces where a point sees all four, and a link where it sees two quadruples with three common
/// faces: the contacts on these belong to both. Where the cell of a quadruple falls apart, points
/// do not tell its components from each other, and the quadruple is one vertex with the links of
/// all.
struct SampledGraph {
  std::vector<FaceQuadruple> quadruples;             ///< ascending
  std::vector<std::array<QuadrupleIndex, 2>> links;  ///< ascending
  int components = 0;
};

/// @param points  drawn evenly in `region`, the same for the same seed.
/// @throws TimeUp  the deadline came.
[[nodiscard]] SampledGraph SamplePolyhedron(const object::Polyhedron& solid, double half_angle,
                                            planning::Spanning spanning,
                                            const Eigen::AlignedBox3d& region, int points,
                                            std::uint64_t seed, const Deadline& deadline = {},
                                            const Tell& tell = {});

/// How much of the direct graph sampling found.
[[nodiscard]] planning::SamplingShare CompareSampling(const SampledGraph& sampled,
                                                      const PolyhedronGraph& graph);

}  // namespace regrasp::polyhedron
