#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/grasp/contact.h"
#include "planner/object/polyhedron.h"
#include "planner/sets/polyhedron/face_part.h"

namespace regrasp::polyhedron {

/// Return the depth of a point of the plane inside a part; negative outside.
[[nodiscard]] double DepthIn(const FacePart& part, const Eigen::Vector2d& y);

/// Find a contact on a part that a focus point sees, well inside both its cone and the part.
///
/// It maximizes the smaller of the distances from both borders.
/// @param tangent  tangent of the angle of the cone about the contact's normal.
[[nodiscard]] Eigen::Vector3d ContactFor(const FacePart& part, double tangent,
                                         const Eigen::Vector3d& focus);

/// Draw a random contact that the focus point sees; if no draw is on the part, return ContactFor.
[[nodiscard]] Eigen::Vector3d DrawContact(const FacePart& part, double tangent,
                                          const Eigen::Vector3d& focus, RandomStream& random);

/// Focus point of a concurrent grasp with its contact regions, for images.
struct FocusView {
  /// Focus point deepest inside the contacts' cones.
  Eigen::Vector3d focus = Eigen::Vector3d::Zero();
  /// Regions in which contacts can move independently on their faces while the focus point sees
  /// them (Phoka 2010, section 5.3.1). There is one closed outline per convex part of a face.
  std::vector<std::vector<Eigen::Vector3d>> regions;
};

/// Find the focus point of four contacts whose faces are set, with cones of angle φ = min(θ, φ*).
/// @param friction_angle  friction angle θ, rad.
/// @returns nullopt if the grasp is not concurrent or does not have four contacts.
[[nodiscard]] std::optional<FocusView> DescribeFocus(const object::Polyhedron& solid,
                                                     const grasp::Grasp& grasp,
                                                     double friction_angle);

}  // namespace regrasp::polyhedron
