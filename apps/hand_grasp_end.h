#pragma once

#include <optional>
#include <string>

#include "sim/hand_grasps/hand_grasp.h"

namespace regrasp::apps {

/// Hand grasp that is the start or the goal of a plan.
struct NamedHandGrasp {
  sim::HandGrasp grasp;
  std::string name;  ///< file and line, for messages
};

/// Return the file of a value FILE or FILE:NAME. The value itself if it has no file.
[[nodiscard]] std::string FileOfEnd(const std::string& value);

/// Read a hand grasp from a value FILE or FILE:NAME.
/// @param option  name of the option in messages.
/// @returns nullopt if the file does not exist or is not a file of hand grasps.
/// @throws InputError  if no grasp has the name, several have it, the file has several grasps and
///     the value has no name, or the grasp is invalid.
[[nodiscard]] std::optional<NamedHandGrasp> FindHandGrasp(const std::string& option,
                                                          const std::string& value);

/// Return whether a text is that of a hand grasp, which need not be valid.
[[nodiscard]] bool IsHandGrasp(const std::string& text);

}  // namespace regrasp::apps
