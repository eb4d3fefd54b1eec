#pragma once

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <vector>

#include "planner/kinematics/hand_model.h"

namespace regrasp::kinematics {

/// What a link looks like, in the frame of the last joint that moves it, metres.
struct LinkVisual {
  struct Capsule {
    Eigen::Vector3d from, to;
    double radius;
  };
  FingerIndex finger;  ///< not valid: the palm
  int after = 0;       ///< joints of the finger that move it
  std::vector<Capsule> capsules;
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;  ///< counter-clockwise from outside
};

/// The palm and the links of the fingers, as the model draws them: geoms that collide with nothing
/// where a body has such, otherwise those that collide.
/// @throws InputError  as ReadHand.
[[nodiscard]] std::vector<LinkVisual> ReadHandVisuals(const std::filesystem::path& hand_file,
                                                      const HandModel& hand);

/// Where a link is in the palm's frame.
/// @param joints  angles by finger, from the palm to the tip, radians.
[[nodiscard]] Eigen::Isometry3d LinkPose(const LinkVisual& link, const HandModel& hand,
                                         const std::vector<std::vector<double>>& joints);

}  // namespace regrasp::kinematics
