#pragma once

#include <optional>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/object.h"

namespace regrasp::tree {

/// Path of a contact along the surface.
/// The contacts alternate between two kinds of pairs. The first two, and then every other two, are
/// on one face with a straight line inside it between them. The pairs in between are at one point
/// of an edge, on either face.
using SurfaceRoute = std::vector<grasp::Contact>;

/// Limits on routes.
struct RouteLimits {
  /// Largest number of faces after the first one.
  int crossings = 3;
  /// Largest angle of normals at a concave edge, radians; 0: no concave edges. A fingertip of
  /// radius r that is tangent to one side penetrates the other by r·(1 − cos of the angle). No
  /// clearance is required there, so the caller must check this.
  double concave = 0;
};

/// Search for a short path of a contact: inside its face, over convex edges, or as the limits
/// allow.
/// At convex edges it crosses at points with clearance for a fingertip (HasClearance).
///
/// Faces are expanded nearest first (A*, Hart, Nilsson and Raphael 1968). Each is entered at the
/// point at which the straight line to the end, with the edge's other side unfolded, crosses the
/// edge. The edge points of the route are then repeatedly moved to the straight line between their
/// neighbours in the same manner. Over one edge the path is the shortest one, except near corners
/// of faces (kFromCorner).
///
/// Laws: over one edge the reversed path has the same length; never shorter than the straight line.
/// @returns the path; nullopt if there is none within the limits, or the borders of faces that are
///     not convex cut it off.
[[nodiscard]] std::optional<SurfaceRoute> FindSurfaceRoute(const object::Object& object,
                                                           const grasp::Contact& from,
                                                           const grasp::Contact& to,
                                                           const RouteLimits& limits = {});

/// Share of an edge at its ends that routes avoid, because adjacent faces would block them.
inline constexpr double kFromCorner = 0.02;

[[nodiscard]] double LengthOf(const SurfaceRoute& route);

}  // namespace regrasp::tree
