#pragma once

#include <string>

namespace regrasp::apps {

/// Grasps of a data set in a third-party format, which regrasp-convert converts.
struct GraspSource {
  std::string grasps;  ///< file or folder
  std::string hand;    ///< hand file
  std::string object;  ///< object file that names the object of all grasps; a folder does not
  std::string palm;    ///< pose of the palm (regrasp-convert --palm); empty: identity
};

/// Return whether evaluate converts the grasps first: a folder, or a file in a third-party format
/// by its suffix.
[[nodiscard]] bool NeedsConversion(const std::string& grasps);

/// Convert grasps to JSON Lines by regrasp-convert.
/// The program is that in the folder of this program, otherwise that in PATH.
/// @param output  file of hand grasps.
/// @returns exit code of regrasp-convert, which has reported its errors.
/// @throws EnvironmentError  if regrasp-convert cannot be executed or is killed.
[[nodiscard]] int ConvertGrasps(const GraspSource& source, const std::string& output);

}  // namespace regrasp::apps
