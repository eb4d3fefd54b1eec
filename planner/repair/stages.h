#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/json.h"
#include "planner/object/polygon_soup.h"

namespace regrasp::repair {

/// Why what a stage made is not the solid that is asked for.
enum class Shortfall {
  kNone,           ///< it is
  kNoResult,       ///< the stage failed
  kNoSolid,        ///< the reader refuses it
  kSeveralSolids,  ///< the reader refuses it for nothing else
  kNotChosen,      ///< of several solids beside each other none was chosen that is there
  kTooFar,         ///< from the original
  kNotAllThere,    ///< too much of it was invented
  kSheet,          ///< the two sides of an open surface
};

/// A stage that was tried.
struct StageReport {
  std::string stage;            ///< its name in reports: "clean", "fill-holes", …
  std::string outcome;          ///< "solid", or why what it made is none
  Json facts = Json::object();  ///< what it did
  std::size_t facets = 0;
  Shortfall shortfall = Shortfall::kNoResult;
  double deviation = 0;  ///< with kTooFar, over the diameter
};

/// What a stage of the repair made of a surface.
struct StageResult {
  object::PolygonSoup soup;
  /// What it did, for the report: counts and sizes by their names, lengths in the object's unit.
  Json facts = Json::object();
};

// The stages, each a function from a surface to a surface, run in a child process: what they rest
// on is meant for surfaces that are better than these, and crashes on some.
// They throw std::runtime_error with what they cannot do.

/// The surface of a cloud of points (Cohen-Steiner and Da, advancing front, 2004), without
/// triangles that bridge what was not scanned. Facts: "scatter", how widely a point's neighbours
/// are spread across their plane, over how widely they are along it where they are least: near 0 on
/// a surface, 1 in all directions alike (of the points' scatters the middle one).
/// @param cloud  vertices without facets.
[[nodiscard]] StageResult ReconstructSurface(const object::PolygonSoup& cloud);

/// Cuts facets into triangles, makes vertices within kWeldDistance one, drops facets without area
/// and doubled ones, and turns neighbours the same way round. What comes out is a set of triangles
/// without edges of three or more: vertices are doubled where parts merely touch.
/// @throws std::runtime_error  nothing is left.
[[nodiscard]] StageResult CleanSurface(const object::PolygonSoup& soup);

/// Fills every hole with triangles. Facts: the holes, how long their borders are and how wide.
/// @param soup  as CleanSurface makes it.
[[nodiscard]] StageResult FillHoles(const object::PolygonSoup& soup);

/// Makes one body of closed shells: those that are solid are united, cavities are taken out.
/// @param soup  closed; no shell meets itself.
[[nodiscard]] StageResult UniteShells(const object::PolygonSoup& soup);

/// Of solids beside each other the one that is the `part`-th by volume, counted from 1, with its
/// cavities. Facts: the shares of the volume.
/// @param soup  closed, no shells meet.
[[nodiscard]] StageResult TakePart(const object::PolygonSoup& soup, int part);

/// Cuts facets that meet each other out and fills the gaps. Facts: pairs before.
/// @param soup  closed.
[[nodiscard]] StageResult RemoveCrossings(const object::PolygonSoup& soup);

/// Cuts all facets where they meet, in exact arithmetic, and keeps those pieces that lie between
/// the outside and what the surface winds about at least once: the boundary of all that is inside,
/// however its shells pass through themselves and each other. Facts: pairs that meet.
/// @param soup  closed.
[[nodiscard]] StageResult ArrangeSurface(const object::PolygonSoup& soup);

/// Wraps a surface from outside: a ball of kWrapDetail · D that cannot enter an opening smaller
/// than itself rolls about it (Portaneri and others, Alpha wrapping with an offset, 2022), and the
/// result is drawn back onto the surface. Facts: the volume from coarse wraps to fine ones.
[[nodiscard]] StageResult WrapSurface(const object::PolygonSoup& soup);

/// A sheet of some thickness about an open surface.
[[nodiscard]] StageResult Solidify(const object::PolygonSoup& soup, double thickness);

/// At most so many facets (Lindstrom and Turk's edge collapse). Where facets meet by it, it is done
/// anew without collapses there, and then without such as turn facets over; as it was at first
/// where they meet all the same.
/// @param soup  the surface of a solid.
[[nodiscard]] StageResult Simplify(const object::PolygonSoup& soup, int facets);

/// A cloud of more scatter than this makes no surface.
inline constexpr double kMostScatter = 0.5;

/// Vertices this close, over the diameter, are one: what 32-bit coordinates are rounded to.
inline constexpr double kWeldDistance = 1e-6;

/// Radius of the ball that wraps, over the diameter: openings that are narrower are closed.
inline constexpr double kWrapDetail = 0.01;

/// How far outside of the surface the wrap lies before it is drawn back, over kWrapDetail.
inline constexpr double kWrapOffset = 0.1;

}  // namespace regrasp::repair
