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

/// What a route may go over.
struct RouteLimits {
  /// Faces after its first one.
  int crossings = 3;
  /// Radians that the normal may turn by at a concave edge: 0 for none. A fingertip of radius r
  /// that is tangent to one side there is in the other one by r·(1 − cos of the turn); who allows
  /// it judges that, as no clearance is asked for then.
  double concave = 0;
};

/// Looks for a short path from one contact to another: inside their face, or over convex edges, at
/// points where a fingertip has clearance (HasClearance), or over others as the limits allow.
///
/// Faces are tried from the nearest on (A*, Hart, Nilsson and Raphael 1968), each entered where
/// the straight line to the end, the edge's other side unfolded, crosses the edge; then the points
/// of the route's edges are pulled straight between their neighbours in the same manner. Over one
/// edge the path is the shortest one, corners of faces excepted (kFromCorner).
///
/// Laws: the path back has the same length over one edge; never shorter than the straight line.
/// @returns nullopt where there is none within the limits, or it is cut off by the borders of faces
///          that are not convex.
[[nodiscard]] std::optional<SurfaceRoute> FindSurfaceRoute(const object::Object& object,
                                                           const grasp::Contact& from,
                                                           const grasp::Contact& to,
                                                           const RouteLimits& limits = {});

/// Routes keep this share of an edge away from its ends: faces beyond would block them.
inline constexpr double kFromCorner = 0.02;

[[nodiscard]] double LengthOf(const SurfaceRoute& route);

}  // namespace regrasp::tree
