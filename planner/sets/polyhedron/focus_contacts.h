#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/grasp/contact.h"
#include "planner/object/polyhedron.h"
#include "planner/sets/polyhedron/face_part.h"

namespace regrasp::polyhedron {

/// How far inside a part a point of its plane is; negative outside.
[[nodiscard]] double DepthIn(const FacePart& part, const Eigen::Vector2d& y);

/// The contact on a part that is best both inside the cone about its normal, half-angle of the
/// given tangent, that a focus point sees it in, and inside the part: by the smaller of the two
/// distances.
[[nodiscard]] Eigen::Vector3d ContactFor(const FacePart& part, double tangent,
                                         const Eigen::Vector3d& focus);

/// A random contact that the focus point sees; where draws find none on the part, the best one.
[[nodiscard]] Eigen::Vector3d DrawContact(const FacePart& part, double tangent,
                                          const Eigen::Vector3d& focus, RandomStream& random);

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
