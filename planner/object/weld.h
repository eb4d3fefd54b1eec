#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "planner/object/polygon_soup.h"

namespace regrasp::object {

/// Largest absolute coordinate; larger ones are rejected.
///
/// Inertia requires products of up to five factors, which would approach the range of double. No
/// object is that large.
inline constexpr double kMaxCoordinate = 1e15;

/// Smallest diameter; smaller objects are rejected, because products would underflow.
inline constexpr double kMinDiameter = 1e-15;

/// Largest distance of an object from the origin, divided by its diameter.
///
/// Coordinates there are rounded to 1e-9 of the diameter, a thousandth of the point tolerance.
inline constexpr double kMaxOffset = 1e7;

/// Length of the shortest edge divided by the diameter; shorter ones are rejected.
///
/// Products of up to five lengths then stay within the range of double. Two corners that differ
/// only by a program's rounding are 1e-17 apart.
inline constexpr double kMinEdge = 1e-30;

/// Maximum number of polygons of a mesh and of edges of a polygon, far above any that can be
/// planned on.
inline constexpr std::size_t kMaxFacets = 1'000'000;

/// Maximum number of pairs of polygons or edges with overlapping boxes.
///
/// More would take minutes to check for intersection; a finely meshed object has about ten pairs
/// per polygon.
inline constexpr std::size_t kMaxOverlaps = 30'000'000;

/// Return the problem of the size or position of vertices as text; empty if there is none.
[[nodiscard]] std::string SizeComplaint(const std::vector<Eigen::Vector3d>& vertices,
                                        double diameter);

/// Return the problem of the length of an edge as text; empty if there is none.
[[nodiscard]] std::string EdgeComplaint(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                        double diameter);

/// Soup without equal or unused vertices.
///
/// Polygons are those of the file, in its order; dropped ones have no corners.
struct WeldedSoup {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<int> vertex_in_file;  ///< index of the first equal vertex in the file
  std::vector<std::vector<int>> facets;
};

/// Merge vertices whose coordinates are exactly equal, and drop unused ones.
///
/// STL lists each vertex several times; exporters of OBJ and PLY split vertices along seams. A
/// corner that repeats the one before it is dropped. A polygon with fewer than three remaining
/// corners has no area and is dropped, too.
/// @throws MeshError  if there is no polygon or too many, an index is out of range, or a coordinate
///     is not finite or beyond kMaxCoordinate.
[[nodiscard]] WeldedSoup WeldVertices(const PolygonSoup& soup, const std::string& name);

/// Drop corners that repeat the one before them; drop all if fewer than three remain.
void DropRepeated(std::vector<int>& corners);

/// Drop unused vertices; the others keep their order.
void DropUnused(WeldedSoup& soup);

/// Polygon with the corners of an earlier one, in the same or the opposite order.
struct RepeatedFacet {
  int facet;
  int first;  ///< first polygon with these corners
  bool same_way;
};

/// Find polygons that have the corners of an earlier one, sorted by the earlier one.
///
/// `facets` lists the vertex indices of each polygon, without repetition. Polygons without corners
/// are ignored.
[[nodiscard]] std::vector<RepeatedFacet> FindRepeatedFacets(
    const std::vector<std::vector<int>>& facets);

/// Fix those defects of a soup that do not require moving its surface.
///
/// The steps, in this order:
///
/// - Close open edges: merge their ends if they are within kPointTolerance · D of each other, at
///   the position of the first. Other vertices do not move.
/// - Drop polygons without area. If one connects several edges along a line, the polygons at these
///   edges get its corners.
/// - Drop repeated polygons. Two with the same corners and opposite orientation form a wall without
///   thickness, and both are dropped. One of the remaining ones with the same corners is kept.
///
/// Call it only for soups that are not closed manifolds; it may change sound ones. The result may
/// still not be a closed manifold. Polygons keep their numbers; dropped ones have no corners.
/// @param diameter  diameter D of the object.
/// @returns whether the soup was changed.
bool RepairSoup(WeldedSoup& soup, double diameter);

}  // namespace regrasp::object
