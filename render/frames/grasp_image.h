#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "planner/kinematics/hand_visuals.h"
#include "planner/object/object.h"
#include "render/picture/image.h"

namespace regrasp::render {

/// A hand around an object.
struct GraspScene {
  std::vector<kinematics::LinkVisual> hand;  ///< in the palm's frame, metres (VisualsAt)
  Eigen::Isometry3d palm = Eigen::Isometry3d::Identity();  ///< in the object's frame, metres
  double scale = 1;                                        ///< metres per unit of the object
  std::vector<Eigen::Vector3d> contacts;                   ///< in the object's frame, metres
};

/// Draw a grasp: the object, the translucent hand around it, and its contacts.
///
/// The view is oblique, from the side of the object that is away from the palm. Deterministic: the
/// same scene gives the same bytes.
/// @param caption  text below the hand.
/// @param width    width and height of the image, pixels.
/// @throws EnvironmentError  if off-screen rendering is not available.
[[nodiscard]] Image DrawGraspScene(const GraspScene& scene, const object::Object& object,
                                   const std::string& caption, int width);

}  // namespace regrasp::render
