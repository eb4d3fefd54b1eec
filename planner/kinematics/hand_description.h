#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace regrasp::kinematics {

/// What `hand.json` says of a model (docs/formats.md): which of its bodies are what, and how the
/// fingers touch. Lengths in metres, in the frames of the model's bodies.
struct HandDescription {
  struct Tip {
    std::string name;  ///< of the finger
    std::string body;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double radius = 0;
  };
  /// angle of `joint` = ratio · angle of `follows` + offset, radians.
  struct Coupling {
    std::string joint;
    std::string follows;
    double ratio = 1;
    double offset = 0;
  };

  std::string name;
  std::string model;                              ///< file of the model, relative to this one
  std::string palm;                               ///< body
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< in the palm's frame, of length 1
  std::vector<Tip> tips;
  std::vector<Coupling> couplings;
};

/// @param name  how messages call the file.
/// @throws InputError
[[nodiscard]] HandDescription ParseHandDescription(std::string_view text, const std::string& name);

/// The text of a file: same description, same bytes.
[[nodiscard]] std::string FormatHandDescription(const HandDescription& description);

}  // namespace regrasp::kinematics
