#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/polyhedron.h"

namespace regrasp::polyhedron {

/// What a picture shows of a concurrent grasp: a focus point and the contact regions that it gives.
struct FocusView {
  /// Deepest inside the contacts' cones.
  Eigen::Vector3d focus = Eigen::Vector3d::Zero();
  /// Where contacts may stand, each on its own face independently of the others, while the focus
  /// point sees them all (Phoka 2010, section 5.3.1): closed outlines, one for each convex part of
  /// a face.
  std::vector<std::vector<Eigen::Vector3d>> regions;
};

/// The focus point of four contacts that know their faces, with cones of half-angle φ = min(θ, φ*);
/// nullopt where there is none: the grasp is not concurrent, or has not four contacts.
/// @param half_angle  θ, radians.
[[nodiscard]] std::optional<FocusView> DescribeFocus(const object::Polyhedron& solid,
                                                     const grasp::Grasp& grasp, double half_angle);

}  // namespace regrasp::polyhedron
