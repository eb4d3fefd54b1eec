#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "planner/planning/in_hand_task.h"

namespace regrasp::bench {

/// Task for a hand and an object: rotate it about its centroid and move the centroid, both along
/// the object's axes at the start. The planner chooses the initial pose in the hand, so that every
/// hand can run the same task.
struct Task {
  std::string name;   ///< name: "turn/cube-50/z90"
  std::string group;  ///< group of results counted together: "turn-90"
  std::string body;
  std::string after;  ///< task whose final pose and contacts are the start; empty: any start
  planning::Turn turn;
  Eigen::Vector3d move_m = Eigen::Vector3d::Zero();

  /// Return true for a rotation alone: the centroid may then end at another position.
  [[nodiscard]] bool is_turn() const { return move_m.isZero(0); }
};

/// Return the goal pose of the object. @param centre  centroid in the object's frame, m.
[[nodiscard]] Eigen::Isometry3d GoalPose(const Task& task, const Eigen::Vector3d& centre,
                                         const Eigen::Isometry3d& start);

/// Read tasks from a CSV file with the columns name, group, body, after, turn and move_mm.
/// The column turn has axis and degrees ("z 90"), move_mm has three lengths ("20 0 0"). Either may
/// be empty.
/// @throws InputError  if a name occurs twice, if `after` is not the task on the line before or has
///     a different object, or if there is neither turn nor move. The message names the line.
[[nodiscard]] std::vector<Task> ReadTasks(const std::filesystem::path& path);

/// Consecutive tasks, each `after` the one before it.
using Chain = std::vector<Task>;

/// Return the chains in the order of the tasks. @param only  shell patterns, at least one of which
/// must match a name or group of the chain; empty: all chains.
[[nodiscard]] std::vector<Chain> ChainsOf(const std::vector<Task>& tasks,
                                          const std::vector<std::string>& only);

}  // namespace regrasp::bench
