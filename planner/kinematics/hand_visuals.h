#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

#include "planner/kinematics/hand_model.h"

namespace regrasp::kinematics {

struct CompiledModel;
struct HandFile;

/// What a link looks like, in the frame of the last joint that moves it, metres.
struct LinkVisual {
  struct Capsule {
    Eigen::Vector3d from, to;
    double radius;
  };
  FingerIndex finger;               ///< not valid: the palm
  int after = 0;                    ///< joints of the finger that move it
  bool above_palm = false;          ///< of an arm, say, which is fixed to the palm as at rest
  std::array<float, 3> color = {};  ///< red, green, blue in [0, 1]
  std::vector<Capsule> capsules;
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;  ///< counter-clockwise from outside
  std::vector<std::array<Eigen::Vector3d, 3>> normals;    ///< at their corners
};

/// The palm and the links of the fingers, as the model draws them: geoms that collide with nothing
/// and are shown (groups 0 to 2) where a body has such, otherwise those that collide. Those of a
/// link that have one colour are one visual.
/// @param palm  HandDescription::palm.
[[nodiscard]] std::vector<LinkVisual> VisualsOf(const CompiledModel& compiled,
                                                const std::string& palm, const HandModel& hand);

/// The same of a hand that was read from a file.
[[nodiscard]] std::vector<LinkVisual> VisualsOf(const HandFile& file);

/// Where a link is in the palm's frame.
/// @param joints  angles by finger, from the palm to the tip, radians.
[[nodiscard]] Eigen::Isometry3d LinkPose(const LinkVisual& link, const HandModel& hand,
                                         const std::vector<std::vector<double>>& joints);

}  // namespace regrasp::kinematics
