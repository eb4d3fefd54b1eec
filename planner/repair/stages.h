#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/json.h"
#include "planner/object/polygon_soup.h"

namespace regrasp::repair {

/// Reason why the result of a stage is not the required solid.
enum class Shortfall {
  kNone,           ///< accepted
  kNoResult,       ///< the stage failed
  kNoSolid,        ///< the reader rejects the surface
  kSeveralSolids,  ///< the reader rejects the surface only because it is several solids
  kNotChosen,      ///< several separate solids, and the options select none of them
  kTooFar,         ///< too far from the original
  kNotAllThere,    ///< too large a share of filled surface
  kSheet,          ///< both sides of an open surface
};

/// Report of one executed stage.
struct StageReport {
  std::string stage;            ///< name in reports: "clean", "fill-holes", …
  std::string outcome;          ///< "solid", or the reason of rejection
  Json facts = Json::object();  ///< counts and sizes for the report
  std::size_t facets = 0;
  Shortfall shortfall = Shortfall::kNoResult;
  double deviation = 0;  ///< deviation over the diameter; set with kTooFar
};

/// Result of a repair stage.
struct StageResult {
  object::PolygonSoup soup;
  /// Counts and sizes by name, for the report. Lengths are in object units.
  Json facts = Json::object();
};

// Each stage is a function from a surface to a surface. Stages run in a child process because the
// libraries that they use are made for cleaner surfaces and crash on some inputs. A stage that
// fails throws std::runtime_error with the reason.

/// Reconstruct the surface of a point cloud (advancing front, Cohen-Steiner and Da 2004).
/// Removes triangles that bridge unscanned regions. The fact "scatter" is the median over points of
/// the ratio of the neighbours' spread across their plane to their smallest spread in it. It is
/// near 0 on a surface and 1 for an isotropic cloud.
/// @param cloud  vertices without polygons.
[[nodiscard]] StageResult ReconstructSurface(const object::PolygonSoup& cloud);

/// Convert a polygon soup to clean triangles.
/// Triangulates polygons, merges vertices within kWeldDistance, drops degenerate and duplicate
/// triangles and orients neighbours consistently. In the result no edge has more than two
/// triangles: vertices are duplicated where parts only touch.
/// @throws std::runtime_error  if no triangle remains.
[[nodiscard]] StageResult CleanSurface(const object::PolygonSoup& soup);

/// Fill every hole with triangles. The facts list the holes with border length and width.
/// @param soup  result of CleanSurface.
[[nodiscard]] StageResult FillHoles(const object::PolygonSoup& soup);

/// Unite closed shells into one solid. Solid shells are united, cavities are subtracted.
/// @param soup  closed surface whose shells have no self-intersections.
[[nodiscard]] StageResult UniteShells(const object::PolygonSoup& soup);

/// Return one of several separate solids, with its cavities.
/// The fact "volume_shares" lists the volume of each solid over the sum.
/// @param soup  closed surface whose shells do not intersect.
/// @param part  rank of the solid by volume, from 1 (the largest).
[[nodiscard]] StageResult TakePart(const object::PolygonSoup& soup, int part);

/// Remove intersecting triangles and fill the gaps.
/// The fact "crossing_facets" is the number of intersecting triangles before.
/// @param soup  closed surface.
[[nodiscard]] StageResult RemoveCrossings(const object::PolygonSoup& soup);

/// Resolve all intersections of a surface in exact arithmetic.
/// Cuts all triangles along their intersections and keeps the pieces that separate winding number 0
/// from winding number at least 1. The result bounds the whole interior even if shells pass through
/// themselves and each other. The fact "meeting_pairs" is the number of intersecting pairs.
/// @param soup  closed surface.
[[nodiscard]] StageResult ArrangeSurface(const object::PolygonSoup& soup);

/// Wrap a surface from outside (alpha wrapping with an offset, Portaneri et al. 2022).
/// A sphere of radius kWrapDetail · D rolls over the surface. It cannot enter openings narrower
/// than its diameter. The vertices of the wrap are then projected onto the surface. The fact
/// "volumes" lists the volume of a coarser and of the final wrap.
/// @param soup  triangles, not necessarily closed.
[[nodiscard]] StageResult WrapSurface(const object::PolygonSoup& soup);

/// Give an open surface a wall of the given thickness, in object units.
[[nodiscard]] StageResult Solidify(const object::PolygonSoup& soup, double thickness);

/// Reduce a surface to at most `facets` triangles (edge collapse of Lindstrom and Turk).
/// If triangles intersect afterwards, the collapse is repeated without the edges at these places,
/// and then with collapses that flip triangles excluded. If that fails too, the result is that of
/// the first attempt, intersections included.
/// @param soup  surface of a solid.
[[nodiscard]] StageResult Simplify(const object::PolygonSoup& soup, int facets);

/// Scatter beyond which a point cloud is not a surface.
inline constexpr double kMostScatter = 0.5;

/// Welding distance over the diameter: the rounding error of 32-bit coordinates.
inline constexpr double kWeldDistance = 1e-6;

/// Radius of the wrapping sphere over the diameter. Narrower openings are closed.
inline constexpr double kWrapDetail = 0.01;

/// Offset of the wrap from the surface before the projection, over kWrapDetail.
inline constexpr double kWrapOffset = 0.1;

/// Outcome of a stage: a surface, or the reason why there is none.
struct StageRun {
  std::optional<StageResult> result;
  std::string failure;
};

/// Limit of processor time of a stage.
/// A stage takes seconds for a scan and a minute for a million triangles.
inline constexpr std::chrono::seconds kStageTime{300};

/// Run a stage in a child process of limited time and memory.
/// @throws TimeUp  if the deadline passes.
/// @throws EnvironmentError  if no process can be started.
[[nodiscard]] StageRun RunStage(const std::function<StageResult()>& stage, const Deadline& deadline,
                                std::chrono::seconds processor = kStageTime);

/// Return a surface in an order that its coordinates alone determine.
/// Vertices are sorted by coordinates, the corners of each polygon start at its first vertex, and
/// polygons are sorted by their vertices. The reason: the stage that unites shells orders them by
/// memory addresses, which depend on the calling program.
///
/// Law: the result does not depend on the numbering of vertices and polygons, nor on the corner at
/// which a polygon starts. Vertices at the same position keep their order.
[[nodiscard]] object::PolygonSoup InCanonicalOrder(const object::PolygonSoup& soup);

/// Return true iff an edge has one triangle only.
/// @param soup  result of CleanSurface: no edge has more than two triangles.
[[nodiscard]] bool HasOpenEdges(const object::PolygonSoup& soup);

/// Return the shell of each triangle.
/// Shells share no vertex. They are numbered in the order of their first triangles.
[[nodiscard]] std::vector<int> ShellOfFacets(const object::PolygonSoup& soup);

/// Return the number of shells, that is of parts that share no vertex.
[[nodiscard]] int CountShells(const object::PolygonSoup& soup);

}  // namespace regrasp::repair
