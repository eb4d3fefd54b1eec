#pragma once

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "planner/kinematics/hand_model.h"

namespace regrasp::kinematics {

struct CompiledModel;
struct HandFile;

/// Visual shape of a link, in the frame of the last joint that moves it, metres.
struct LinkVisual {
  struct Capsule {
    Eigen::Vector3d from, to;
    double radius;
  };
  FingerIndex finger;               ///< invalid: the palm
  int after = 0;                    ///< number of joints of the finger that move it
  bool above_palm = false;          ///< whether the geom is above the palm, like an arm
  std::array<float, 3> color = {};  ///< red, green, blue in [0, 1]
  std::vector<Capsule> capsules;
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;  ///< counter-clockwise from outside
  std::vector<std::array<Eigen::Vector3d, 3>> normals;    ///< normals at the corners
};

/// Return the visual shapes of the palm and the links of the fingers.
/// Visual geoms of a body are the shown geoms (groups 0 to 2) that do not collide. A body without
/// such geoms is drawn by its colliding geoms. Geoms of one link with one colour form one visual.
/// @param palm  HandDescription::palm.
[[nodiscard]] std::vector<LinkVisual> VisualsOf(const CompiledModel& compiled,
                                                const std::string& palm, const HandModel& hand);

/// Return the visual shapes of the palm and of all links in a configuration, in the palm's frame.
/// They do not move: each has after = 0. Therefore the hand needs no fingers.
/// @param palm    HandDescription::palm.
/// @param joints  positions by joint name, radians or metres. Other joints are at their reference.
[[nodiscard]] std::vector<LinkVisual> VisualsAt(const CompiledModel& compiled,
                                                const std::string& palm,
                                                const std::map<std::string, double>& joints);

/// Return the visual shapes of a hand that was read from a file.
[[nodiscard]] std::vector<LinkVisual> VisualsOf(const HandFile& file);

/// Return the pose of a link in the palm's frame.
/// @param joints  joint angles by finger, from the palm to the fingertip, radians.
[[nodiscard]] Eigen::Isometry3d LinkPose(const LinkVisual& link, const HandModel& hand,
                                         const std::vector<std::vector<double>>& joints);

}  // namespace regrasp::kinematics
