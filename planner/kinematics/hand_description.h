#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace regrasp::kinematics {

/// Contents of `hand.json`: roles of the model's bodies, and the fingertip spheres.
/// The format is in docs/formats.md.
/// Lengths are in metres, in the frames of the model's bodies.
struct HandDescription {
  struct Tip {
    std::string name;  ///< name of the finger
    std::string body;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double radius = 0;
  };
  /// Coupling: angle of `joint` = ratio · angle of `follows` + offset, radians.
  struct Coupling {
    std::string joint;
    std::string follows;
    double ratio = 1;
    double offset = 0;
  };

  std::string name;
  std::string model;  ///< file of the model, relative to the hand's file
  std::string palm;   ///< name of the body
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit vector in the palm's frame
  std::vector<Tip> tips;
  std::vector<Coupling> couplings;
};

/// Parse the text of a hand's file.
/// @param name  name of the file in messages.
/// @throws InputError  if the text is not a hand description.
[[nodiscard]] HandDescription ParseHandDescription(std::string_view text, const std::string& name);

/// Format a description as the text of a file. Equal descriptions give equal bytes.
[[nodiscard]] std::string FormatHandDescription(const HandDescription& description);

}  // namespace regrasp::kinematics
