#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/triangle_mesh.h"
#include "planner/object/weld.h"

namespace regrasp::object {

/// Connected part of a surface without open edges, counted by itself.
struct ClosedShell {
  int first_facet = 0;  ///< number of its first polygon, in file order
  int facets = 0;
  double volume = 0;      ///< volume; negative if it is oriented inward
  bool overlaps = false;  ///< whether its polygons intersect those of another shell
  bool inside = false;    ///< it is inside another shell and does not intersect it
};

/// Counts of all defects that keep a soup from being the surface of one solid.
///
/// Lengths are in units of the soup. Polygons are those of the file; edges are counted after equal
/// vertices are merged.
struct MeshSurvey {
  int facets = 0;
  int vertices = 0;  ///< number of different vertices in use
  double diameter = 0;

  /// Number of polygons with a vertex index out of range, or a coordinate that is NaN or beyond
  /// kMaxCoordinate. All other counts ignore them.
  int spoilt_facets = 0;
  /// Polygons without area: fewer than three different corners, or collinear.
  int degenerate_facets = 0;
  int duplicate_facets = 0;  ///< polygons with the corners of an earlier one, in the same order
  int opposite_facets = 0;   ///< polygons with the corners of an earlier one, in opposite order
  int twisted_facets = 0;    ///< polygons whose outline meets itself
  int bent_facets = 0;       ///< polygons bent beyond kBentTolerance
  double largest_bend = 0;   ///< largest distance of a corner from its polygon's plane

  int open_edges = 0;         ///< edges with one polygon
  int borders = 0;            ///< connected sets of open edges; loops unless they touch
  double longest_border = 0;  ///< largest length of a border, the sum of its edges
  int crowded_edges = 0;      ///< edges with more than two polygons
  int misoriented_edges = 0;  ///< edges that both of their polygons have in the same direction

  int crossing_pairs = 0;  ///< pairs of polygons that meet outside common edges and vertices
  /// False if there may be more crossings, overlapping shells and inner shells than were counted.
  bool all_pairs_seen = true;

  int open_parts = 0;               ///< connected parts of the surface that are not closed shells
  std::vector<ClosedShell> shells;  ///< closed shells, largest volume first
};

/// Limits of the search for crossing pairs: counted pairs, and pairs with overlapping boxes. They
/// bound the time to about a second.
inline constexpr int kMostCrossings = 10000;
inline constexpr std::size_t kMostPairsSurveyed = 3'000'000;

/// Return the shares of the first five volumes in the total: "67.3 %, 30.2 %, 2.48 %".
/// @param volumes  non-negative volumes, largest first.
[[nodiscard]] std::string SharesText(const std::vector<double>& volumes);

/// Count the defects of any soup, in a few tenths of a second for 100,000 polygons.
///
/// Law: a soup that Polyhedron::FromSoup accepts without changes has no defect, with two
/// exceptions. Polygons may be bent within the tolerance, and cavities are counted as shells inside
/// another.
/// @throws MeshError  if there is no polygon, or more than kMaxFacets.
/// @throws TimeUp  if the deadline is reached.
[[nodiscard]] MeshSurvey SurveyMesh(const PolygonSoup& soup, const Deadline& deadline = {});

/// Return the counts of all defects as text; empty if there is none.
///
/// Example: "214 open edges in 3 borders (the longest 0.31 long), 4 crossing pairs".
[[nodiscard]] std::string SurveyText(const MeshSurvey& survey);

/// The largest of several closed shells, with its cavities.
struct LargestShell {
  WeldedSoup soup;   ///< polygons of other shells have no corners
  std::string text;  ///< number and volume of the dropped shells, as text
};

/// Find the closed shell of the largest volume, with its cavities.
///
/// Shells that meet at an edge are separated there, so other shells may intersect each other.
/// Cavities are closed shells inside the largest one with the opposite orientation.
/// @returns nullopt if no shell must be dropped, or a part of the surface is open.
[[nodiscard]] std::optional<LargestShell> FindLargestShell(const WeldedSoup& soup);

/// Connected parts of a surface. An edge with more than two polygons does not connect them.
struct SurfaceParts {
  std::vector<int> of_facet;  ///< part of each polygon; −1 if it was dropped
  std::vector<bool> closed;   ///< whether each part, by itself, is closed
  std::vector<std::vector<int>> facets;
};

/// Find the connected parts of a soup.
/// @param sides  edge sides of the soup.
[[nodiscard]] SurfaceParts FindParts(const WeldedSoup& soup, const std::vector<EdgeSide>& sides);

/// Compute the volume that a closed part encloses; negative if it is oriented inward.
/// `facets` lists the polygons of the part.
[[nodiscard]] double VolumeOf(const WeldedSoup& soup, const std::vector<int>& facets);

/// Compute the winding number of a closed part about a point that is not on it.
///
/// It is the sum of the solid angles (Van Oosterom, Strackee 1983) divided by 4π.
/// `facets` lists the polygons of the part.
[[nodiscard]] double WindingNumber(const WeldedSoup& soup, const std::vector<int>& facets,
                                   const Eigen::Vector3d& point);

}  // namespace regrasp::object
