#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace regrasp::sim {

/// Pose of a hand's palm and positions of its joints.
struct HandConfiguration {
  Eigen::Isometry3d palm = Eigen::Isometry3d::Identity();  ///< palm in the object's frame, metres
  std::map<std::string, double> joints;  ///< positions by joint name, radians or metres
};

/// A grasp of a data set: a whole hand around an object (docs/format_hand_grasps.md).
struct HandGrasp {
  std::string id;
  std::string set;          ///< name of the data set; empty if unknown
  std::string object_file;  ///< file name of the object
  double scale = 1;         ///< metres per unit of the object's file
  HandConfiguration grasp;
  std::optional<HandConfiguration> pregrasp;  ///< configuration before the fingers close
  std::optional<HandConfiguration> target;    ///< configuration that the actuators are commanded to
  /// Closing motion without target, by joint: the joint is commanded to this factor of its upper
  /// limit, or if the factor is negative, to its absolute value times the lower limit.
  std::map<std::string, double> closing;
  std::optional<bool> claimed;  ///< success that the data set claims
  std::optional<double> score;  ///< score of the data set
};

/// Parse a line of a file of hand grasps.
/// Members that pregrasp and target omit are those of the grasp.
/// @param name  name of the line in messages.
/// @throws InputError  if the line is not a hand grasp, or a quaternion is not a unit quaternion.
[[nodiscard]] HandGrasp ParseHandGrasp(std::string_view text, const std::string& name);

}  // namespace regrasp::sim
