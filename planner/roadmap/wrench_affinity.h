#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "planner/base/counted_progress.h"
#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::roadmap {

/// Sides of the pyramid that stands for a friction cone where wrenches are compared.
inline constexpr int kPyramidSides = 8;

/// The unit wrenches of a contact's friction pyramid in the frame, torques over its radius: one a
/// column, counter-clockwise about the inward normal.
using WrenchPyramid = Eigen::Matrix<double, 6, kPyramidSides>;

/// @param half_angle  radians; edges of the pyramid lie on the cone.
/// @param towards     the first edge leans to where this vector points along the surface; must not
///                    be parallel to the normal.
[[nodiscard]] WrenchPyramid PyramidOf(const grasp::Contact& contact,
                                      const object::WrenchFrame& frame, double half_angle,
                                      const Eigen::Vector3d& towards);

/// The pyramid of a contact, its first edge leaning away from the frame's origin, so that it turns
/// with the object.
/// @param others  where the contact is straight above the origin, the first of these that is not
///                decides.
[[nodiscard]] WrenchPyramid PyramidOf(const grasp::Contact& contact,
                                      const object::WrenchFrame& frame, double half_angle,
                                      std::span<const grasp::Contact> others);

/// How differently two contacts act on the object (Phoka 2010, 6.2.2.1): the mean angle between
/// wrenches of the two pyramids matched in order, for the cyclic shift that makes it least;
/// radians.
///
/// Laws: symmetric; 0 for equal pyramids (to 1e-7, the root of a rounding of the cosine);
/// independent of the unit of length and of the object's pose. Angles are right to 7e-5.
[[nodiscard]] double WrenchDistance(const WrenchPyramid& a, const WrenchPyramid& b);

/// All distances between pyramids, N × N.
[[nodiscard]] Eigen::MatrixXd WrenchDistances(std::span<const WrenchPyramid> pyramids,
                                              const Tell& tell = {});

}  // namespace regrasp::roadmap
