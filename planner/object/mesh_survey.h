#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/object/polygon_soup.h"

namespace regrasp::object {

/// A connected part of a surface that has no border, by itself.
struct ClosedShell {
  int first_facet = 0;  ///< of the file
  int facets = 0;
  double volume = 0;      ///< negative where it is oriented inward
  bool overlaps = false;  ///< its facets meet those of another
  bool inside = false;    ///< inside another one, which it does not meet
};

/// All that keeps a soup from being the surface of one solid, counted. Lengths are its own units.
/// Facets are counted as the file has them, edges after equal vertices were made one.
struct MeshSurvey {
  int facets = 0;
  int vertices = 0;  ///< different ones that facets use
  double diameter = 0;

  /// Name a vertex that is not there, or whose coordinates are no numbers or beyond kMaxCoordinate.
  /// Left out of all that follows.
  int spoilt_facets = 0;
  int degenerate_facets = 0;  ///< no area: fewer than three different corners, or all on a line
  int duplicate_facets = 0;   ///< have the corners of an earlier one, in the same order
  int opposite_facets = 0;    ///< have the corners of an earlier one, in the opposite order
  int twisted_facets = 0;     ///< the outline meets itself
  int bent_facets = 0;        ///< beyond kBentTolerance
  double largest_bend = 0;    ///< of all facets: of a corner from the facet's plane

  int open_edges = 0;         ///< have one facet
  int borders = 0;            ///< connected sets of open edges: loops, where they do not touch
  double longest_border = 0;  ///< sum of its edges
  int crowded_edges = 0;      ///< have more than two facets
  int misoriented_edges = 0;  ///< have two, which run along it the same way

  int crossing_pairs = 0;  ///< of facets that meet elsewhere than where they are joined
  /// False: there may be more crossings and shells that overlap than were counted.
  bool all_pairs_seen = true;

  int open_parts = 0;               ///< connected parts of the surface that are no closed shell
  std::vector<ClosedShell> shells;  ///< the largest volume first
};

/// No more crossing pairs are counted, and of no more pairs of neighbours is looked whether they
/// cross: about a second.
inline constexpr int kMostCrossings = 10000;
inline constexpr std::size_t kMostPairsSurveyed = 3'000'000;

/// "67.3 %, 30.2 %, 2.48 %": the shares of the first few volumes in all of them.
/// @param volumes  none negative, the largest first.
[[nodiscard]] std::string SharesText(const std::vector<double>& volumes);

/// Counts the defects of a soup, whatever it is like. Takes some tenths of a second for 100,000
/// facets.
///
/// Law: what Polyhedron::FromSoup accepts without mending has no defect, but for facets whose bend
/// is within the tolerance, and cavities, which are shells inside another.
/// @throws MeshError  no facet is left, or there are more than kMaxFacets.
/// @throws TimeUp  the deadline came.
[[nodiscard]] MeshSurvey SurveyMesh(const PolygonSoup& soup, const Deadline& deadline = {});

/// "214 open edges in 3 borders (the longest 0.31 long), 4 crossing pairs"; empty where nothing is
/// wrong.
[[nodiscard]] std::string SurveyText(const MeshSurvey& survey);

}  // namespace regrasp::object
