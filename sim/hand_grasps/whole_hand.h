#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "planner/kinematics/model_text.h"
#include "planner/kinematics/mujoco_model.h"

namespace regrasp::sim {

/// Name of the body that contains the whole hand, and of the body that moves its palm.
inline constexpr const char* kWholeHandBody = "regrasp_hand";
inline constexpr const char* kWholeHandMount = "regrasp_mount";

/// A hand with all of its links, for grasps in which any link may touch the object.
///
/// It is read from a hand file, of which only the name, the model, the palm and the couplings are
/// used. Therefore grippers with two fingers, prismatic joints and coupled joints are supported.
struct WholeHand {
  std::string name;
  std::string palm;    ///< body of the model
  std::string sha256;  ///< digest of the hand file, the model and its meshes
  std::filesystem::path model_file;
  std::shared_ptr<const kinematics::CompiledModel> compiled;
  /// MJCF of the hand in a free body, whose palm a weld holds at the mount. Without object.
  kinematics::ModelText text;
  double length = 0;  ///< farthest point of the collision geometry from the palm's origin, metres
};

/// Read a hand file and its MJCF or URDF model.
///
/// Constraints of the model that couple joints are kept, and `<mimic>` of a URDF becomes one, as
/// does a coupling of the hand file that the model does not impose. Such a coupling replaces the
/// actuators of its joint. Joints that share an actuator by a fixed tendon remain uncoupled. A URDF
/// gets an actuator for each joint that follows no other, with the force limit of the joint.
/// @throws InputError  if the file is not a hand file, the model is invalid or has physics that
///     cannot be simulated (kinematics::CheckPhysics), or the palm or a coupled joint is not found.
[[nodiscard]] WholeHand ReadWholeHand(const std::filesystem::path& path);

}  // namespace regrasp::sim
