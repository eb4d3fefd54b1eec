#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "planner/object/polygon_soup.h"

namespace regrasp::object {

/// Larger coordinates are refused: their products of up to five factors, which inertia needs, would
/// come near the end of double's range, and no object is that wide.
inline constexpr double kMaxCoordinate = 1e15;

/// Smaller objects are refused, for the same reason at the other end.
inline constexpr double kMinDiameter = 1e-15;

/// An object farther from the origin than this times its diameter is refused: coordinates there are
/// rounded to 1e-9 of the diameter, a thousandth of the tolerance of points.
inline constexpr double kMaxOffset = 1e7;

/// Edges shorter than this times the diameter are refused: their products of up to five factors
/// stay within double's range. Two corners that a program made the same but for rounding are 1e-17
/// apart.
inline constexpr double kMinEdge = 1e-30;

/// Meshes with more facets and polygons with more edges are refused: far above any that can be
/// planned on.
inline constexpr std::size_t kMaxFacets = 1'000'000;

/// More pairs of facets or edges whose boxes overlap are refused, as they would take minutes to
/// check for intersection; a finely meshed body has some ten pairs a facet.
inline constexpr std::size_t kMaxOverlaps = 30'000'000;

/// What is wrong with the size or place of these vertices; empty where nothing is.
[[nodiscard]] std::string SizeComplaint(const std::vector<Eigen::Vector3d>& vertices,
                                        double diameter);

/// What is wrong with the length of an edge; empty where nothing is.
[[nodiscard]] std::string EdgeComplaint(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                        double diameter);

/// A soup in which equal coordinates are one vertex and every vertex is used. Facets are the
/// file's, in its order; what is dropped has no corners.
struct WeldedSoup {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<int> vertex_in_file;  ///< index of the first of the file's vertices there
  std::vector<std::vector<int>> facets;
};

/// Merges vertices whose coordinates are exactly equal (STL lists each several times, OBJ and PLY
/// exporters split them along seams) and drops those that no facet uses.
///
/// A corner that repeats the one before it is dropped, and with it a facet of which fewer than
/// three corners are left: it has no area.
/// @throws MeshError  no facet, too many; an index out of range; a coordinate that is not finite or
///                    beyond kMaxCoordinate.
[[nodiscard]] WeldedSoup WeldVertices(const PolygonSoup& soup, const std::string& name);

/// Drops corners that repeat the one before them, and all where fewer than three are left.
void DropRepeated(std::vector<int>& corners);

/// Drops the vertices that no facet uses; the others keep their order.
void DropUnused(WeldedSoup& soup);

}  // namespace regrasp::object
