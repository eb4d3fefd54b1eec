#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/object/object.h"

namespace regrasp::object {

/// Straight piece of a path along the surface, on one face.
struct SurfaceLeg {
  FaceIndex face = {};
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
};

/// Walk straight along the surface, across borders of faces.
///
/// If the visited faces are unfolded into one plane, the path is a straight segment (Polthier and
/// Schmies 1998). In the plane, the path follows the boundary.
///
/// Laws: independent of rigid motion and of the unit of length. On coplanar faces the end is point
/// + displacement, whatever the borders between them. The return path is the same up to rounding.
/// @param face  face on which the point is.
/// @param displacement  vector in the face's plane; along the edge for a polygon.
/// @returns legs, each beginning at the end of the one before. nullopt if rounding moves the path
///     off the surface, which can happen at a vertex, or after kMostLegs.
[[nodiscard]] std::optional<std::vector<SurfaceLeg>> WalkStraight(
    const Object& object, FaceIndex face, const Eigen::Vector3d& point,
    const Eigen::Vector3d& displacement);

/// Find a path along the surface from a point to another one near it.
///
/// In the plane it is the shorter path along the boundary. In space it is straight on one face and
/// across a border of two neighbours. Between more distant points it may not be the shortest: on
/// each face the path continues to the border in the direction of the goal.
/// @returns nullopt if none is found. In a valley the path can oscillate until kMostLegs.
[[nodiscard]] std::optional<std::vector<SurfaceLeg>> HeadFor(const Object& object, FaceIndex face,
                                                             const Eigen::Vector3d& point,
                                                             FaceIndex goal_face,
                                                             const Eigen::Vector3d& goal);

inline constexpr int kMostLegs = 1000;

}  // namespace regrasp::object
