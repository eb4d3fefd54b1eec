#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sim/scene/contact_patches.h"

namespace regrasp::sim {

/// The convex prism under a contact patch, which a fingertip touches.
struct PatchPrism {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();    ///< a corner of the outline
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: two in the patch, outward
  std::vector<Eigen::Vector2d> outline;                ///< counter-clockwise in the first two axes
  double thickness = 0;                                ///< inward
};

/// A ball that reaches into a prism.
struct PatchTouch {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< of the prism, nearest to the ball's centre
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, from the ball into the prism
  double depth = 0;                                  ///< of the ball in the prism, positive
};

/// @param inward  unit normal of the patch's face, into the object.
[[nodiscard]] PatchPrism MakePrism(const ContactPatch& patch, const Eigen::Vector3d& inward,
                                   double thickness);

/// Where a ball touches a prism: beyond the patch's outline its rim and sides count. Nothing where
/// the ball is off it, or its centre is below it. Exact up to rounding. All lengths in one unit, in
/// the frame of the patch.
[[nodiscard]] std::optional<PatchTouch> TouchPatch(const PatchPrism& prism,
                                                   const Eigen::Vector3d& centre, double radius);

}  // namespace regrasp::sim
