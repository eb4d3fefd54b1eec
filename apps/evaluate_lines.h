#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/hand_grasps/grasp_protocols.h"

namespace regrasp::apps {

inline constexpr char kEvaluateName[] = "evaluate";

/// Command-line values of `evaluate`.
struct EvaluateOptions {
  std::string grasps;  ///< file of hand grasps, JSON Lines
  std::string hand;
  std::string object;  ///< object file, or a folder of object files
  /// Files of the results: JSON Lines, or by suffix CSV (.csv), NPZ (.npz) and HTML (.html).
  std::vector<std::string> outputs;
  std::string images;  ///< folder of an image per grasp; empty: none
  std::vector<sim::GraspProtocol> protocols;
  sim::GraspTest test;
  std::string shard;
  int jobs = 1;
  bool fresh = false;
  bool quiet = false;
};

/// Test all grasps of a file, write one report per grasp, and print the counts and the confusion
/// table of claimed against measured success.
/// @returns exit code of the worst grasp, as RunLinesFile.
/// @throws InputError, EnvironmentError  as RunLinesFile, and if the hand cannot be read.
[[nodiscard]] int RunEvaluate(const EvaluateOptions& options);

}  // namespace regrasp::apps
