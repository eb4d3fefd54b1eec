#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/object/object.h"

namespace regrasp::object {

/// A straight piece of a way along the surface, on one face.
struct SurfaceLeg {
  FaceIndex face = {};
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
};

/// Goes straight along the surface, across borders: on the faces that it comes to, unfolded into
/// one plane, the way is a straight segment (Polthier and Schmies 1998). In the plane it goes along
/// the boundary.
///
/// Laws: independent of rigid motion and of the unit of length; on faces that lie in one plane the
/// end is point + displacement, however they are cut; the way back is the same, but for rounding.
/// @param face          that the point lies on.
/// @param displacement  in the face's plane, along the edge of a polygon.
/// @returns the legs, each beginning where the one before it ends; nullopt where rounding takes the
///          way off the surface, as it may at a vertex, or after kMostLegs.
[[nodiscard]] std::optional<std::vector<SurfaceLeg>> WalkStraight(
    const Object& object, FaceIndex face, const Eigen::Vector3d& point,
    const Eigen::Vector3d& displacement);

/// A way along the surface from a point to another one near it. In the plane the shorter way along
/// the boundary; in space straight on the same face and across a border of two neighbours, from
/// farther away not the shortest: on each face it goes on to the border towards the goal.
/// @returns nullopt where it finds none: in a valley it goes to and fro, until kMostLegs.
[[nodiscard]] std::optional<std::vector<SurfaceLeg>> HeadFor(const Object& object, FaceIndex face,
                                                             const Eigen::Vector3d& point,
                                                             FaceIndex goal_face,
                                                             const Eigen::Vector3d& goal);

inline constexpr int kMostLegs = 1000;

}  // namespace regrasp::object
