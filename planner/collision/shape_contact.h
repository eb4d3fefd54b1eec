#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/collision/ball_contact.h"
#include "planner/collision/convex_shape.h"
#include "planner/collision/hull_distance.h"

namespace regrasp::collision {

/// Contact of a shape with a surface, or their nearest point.
struct SurfaceContact {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< point on the surface
  Eigen::Vector3d outward = Eigen::Vector3d::UnitZ();
  double gap = 0;  ///< metres; negative: penetration depth
};

/// Convex shape with its points in a tree, for shapes of many points.
struct TreeShape {
  explicit TreeShape(const ConvexShape& shape) : points(shape.points), radius(shape.radius) {}

  PointTree points;
  double radius;
};

/// Find the contacts of a convex shape with the exact surface of a solid.
///
/// Each point of the shape is a sphere of the shape's radius and has the contacts of that sphere
/// (BallContact). If other points are nearest, there is one more contact: an edge of the shape at
/// an edge of the solid, or a side of the shape at a corner of the solid. A point inside the solid
/// has a contact at most kMostInside deep; this occurs if shapes overlap before they are separated.
/// If the hull intersects the surface without such a point, the contact is along the line to the
/// centre of the shape. Contacts within kApart of a deeper one are redundant and omitted. At most
/// the kMostContacts deepest contacts are returned.
///
/// Laws: a single point has the contacts of BallContact::Find. Rigid motion moves the contacts.
/// @param shape  shape with positive radius in the solid's frame, metres. Contacts of edges inside
///     the solid are found up to the depth of the radius.
/// @param among  result of BallContact::Around: triangles within kMostInside and the radius of the
///     shape.
/// @returns contacts, the deepest first.
[[nodiscard]] std::vector<SurfaceContact> FindContacts(const BallContact& surface,
                                                       const TreeShape& shape,
                                                       const std::vector<int>& among);

/// Find the nearest point of the surface to a shape.
/// If the hull of the shape's points intersects the surface, the gap is at most minus the radius,
/// and is only an estimate.
/// @returns nullopt if the hull is farther from the surface than `reach`.
[[nodiscard]] std::optional<SurfaceContact> FindNearest(const BallContact& surface,
                                                        const TreeShape& shape, double reach,
                                                        const std::vector<int>& among);

inline constexpr double kMostInside = 5e-3;  ///< metres
inline constexpr double kApart = 1e-3;       ///< metres
inline constexpr int kMostContacts = 8;

}  // namespace regrasp::collision
