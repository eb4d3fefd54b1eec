#pragma once

#include <optional>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/object.h"

namespace regrasp::tree {

/// The path of a contact along the surface. Of contacts that follow each other the first two, then
/// every other two lie on one face, with a straight line inside it between them; the pairs between
/// them lie at one point of an edge, on the one face and on the other.
using SurfaceRoute = std::vector<grasp::Contact>;

/// Faces that a route goes over after its first one, at most.
inline constexpr int kMostCrossings = 3;

/// Looks for a short path from one contact to another: inside their face, or over convex edges, at
/// points where a fingertip has clearance (HasClearance).
///
/// Faces are tried from the nearest on (A*, Hart, Nilsson and Raphael 1968), each entered where
/// the straight line to the end, the edge's other side unfolded, crosses the edge; then the points
/// of the route's edges are pulled straight between their neighbours in the same manner. Over one
/// edge the path is the shortest one, corners of faces excepted (kFromCorner).
///
/// Laws: the path back has the same length over one edge; never shorter than the straight line.
/// @returns nullopt where there is none, or it is cut off by the borders of faces that are not
///          convex.
[[nodiscard]] std::optional<SurfaceRoute> FindSurfaceRoute(const object::Object& object,
                                                           const grasp::Contact& from,
                                                           const grasp::Contact& to);

/// Routes keep this share of an edge away from its ends: faces beyond would block them.
inline constexpr double kFromCorner = 0.02;

[[nodiscard]] double LengthOf(const SurfaceRoute& route);

}  // namespace regrasp::tree
