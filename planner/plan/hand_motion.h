#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace regrasp::plan {

/// How a hand and the object in it stand at an instant.
struct HandState {
  /// Of the object's frame (its file's axes and origin, lengths in metres) in the palm's frame.
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  /// Angles by finger, from the palm to the tip, as the hand's model has them, radians.
  std::vector<std::vector<double>> joints;
};

/// States that follow each other. Between two of them joints go straight, the object's origin goes
/// straight and its orientation turns about one axis at an even rate, all in the same time.
using HandPath = std::vector<HandState>;

/// A finger switch as a hand does it: fingers come to their contacts, then others leave theirs. The
/// first state of each is the last one before it.
struct SwitchMotion {
  HandPath place;
  HandPath release;
};

/// The hand that a plan is for, and how it stands with the initial grasp.
struct HandUse {
  std::string name;
  std::string file;    ///< of the hand, without folders
  std::string sha256;  ///< kinematics::HandModel::sha256
  HandState initial;
  Eigen::Isometry3d goal = Eigen::Isometry3d::Identity();  ///< where the object is to be at last
};

}  // namespace regrasp::plan
