#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "planner/sets/polyhedron/polyhedron_graph.h"

namespace regrasp::polyhedron {

/// A box that contains the focus points of all cells of a graph. Its sides are bounds by cutting
/// planes of the cells' own intersections, within a thousandth of its size; empty where the graph
/// is.
[[nodiscard]] Eigen::AlignedBox3d FindSamplingRegion(const object::Polyhedron& solid,
                                                     PolyhedronGraph& graph);

/// What random focus points find of the switching graph (Phoka 2010, section 5.3.4.2): a quadruple
/// of faces where a point sees all four, and a link where it sees two quadruples with three common
/// faces: the contacts on these belong to both. Where the cell of a quadruple falls apart, points
/// do not tell its components from each other, and the quadruple is one vertex with the links of
/// all.
struct SampledGraph {
  std::vector<std::array<int, 4>> quadruples;  ///< ascending
  std::vector<std::array<int, 2>> links;       ///< ascending, of quadruples
  int components = 0;
};

/// @param points  drawn evenly in `region`, the same for the same seed.
[[nodiscard]] SampledGraph SamplePolyhedron(const object::Polyhedron& solid, double half_angle,
                                            planning::Spanning spanning,
                                            const Eigen::AlignedBox3d& region, int points,
                                            std::uint64_t seed);

/// How much of the direct graph sampling found. Quadruples, as sampling does not tell components of
/// one quadruple apart.
struct SamplingShare {
  std::int64_t quadruples = 0;        ///< of the direct graph
  std::int64_t found_quadruples = 0;  ///< of these
  std::int64_t links = 0;             ///< between quadruples of the direct graph
  std::int64_t found_links = 0;       ///< of these
};
[[nodiscard]] SamplingShare CompareSampling(const SampledGraph& sampled,
                                            const PolyhedronGraph& graph);

}  // namespace regrasp::polyhedron
