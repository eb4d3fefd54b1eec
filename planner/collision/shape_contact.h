#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/collision/ball_contact.h"
#include "planner/collision/convex_shape.h"

namespace regrasp::collision {

/// Where a shape and a surface touch, or are nearest.
struct SurfaceContact {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< of the surface
  Eigen::Vector3d outward = Eigen::Vector3d::UnitZ();
  double gap = 0;  ///< metres; negative: so deep
};

/// Where a convex shape touches a solid's true surface: what BallContact is for balls.
///
/// Each point of the shape is a ball of its radius, and there is a contact where that one has one.
/// Where two others are nearest, as an edge across an edge or a corner of the solid under a side of
/// the shape, there is one, too. A point that is inside the solid, as happens where shapes overlap
/// before they are pushed apart, has a contact up to kMostInside deep; where none is that meets the
/// surface nevertheless (edges do), it is along the line to the middle of the shape. Contacts
/// within kApart of a deeper one add nothing and are left out, and so are those beyond the
/// kMostContacts deepest.
///
/// Laws: of a single point as BallContact::Find; rigid motion moves the contacts.
/// @param shape  in the solid's frame, metres, with a radius: as far as edges are in the solid
///               contacts are found by it.
/// @param among  BallContact::Around: triangles within kMostInside and the radius of the shape.
/// @returns the deepest first.
[[nodiscard]] std::vector<SurfaceContact> FindContacts(const BallContact& surface,
                                                       const ConvexShape& shape,
                                                       const std::vector<int>& among);

/// Where the shape is nearest to the surface, and the hull of its points nearer than `reach`. Where
/// that meets the surface the gap is no larger than minus the radius, and is no more than a guess.
/// @returns nullopt where it is farther.
[[nodiscard]] std::optional<SurfaceContact> FindNearest(const BallContact& surface,
                                                        const ConvexShape& shape, double reach,
                                                        const std::vector<int>& among);

inline constexpr double kMostInside = 5e-3;  ///< metres
inline constexpr double kApart = 1e-3;       ///< metres
inline constexpr int kMostContacts = 8;

}  // namespace regrasp::collision
