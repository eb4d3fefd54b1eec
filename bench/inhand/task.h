#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "planner/planning/in_hand_task.h"

namespace regrasp::bench {

/// What a hand is to do with a body: turn it about its centroid and move the centroid, both along
/// the body's own axes as they are at the start. Where in the hand it starts is the planner's
/// choice, so that the same task can be put to every hand.
struct Task {
  std::string name;   ///< "turn/cube-50/z90"
  std::string group;  ///< whose results are counted together: "turn-90"
  std::string body;
  std::string after;  ///< the task whose end is the start, pose and contacts; empty: any start
  planning::Turn turn;
  Eigen::Vector3d move_m = Eigen::Vector3d::Zero();

  /// A turn alone: the centroid may end elsewhere, wherever the hand has room.
  [[nodiscard]] bool is_turn() const { return move_m.isZero(0); }
};

/// Where a body is to end. @param centre  its centroid in its own frame, metres.
[[nodiscard]] Eigen::Isometry3d GoalPose(const Task& task, const Eigen::Vector3d& centre,
                                         const Eigen::Isometry3d& start);

/// Reads tasks from a CSV file with the columns name, group, body, after, turn ("z 90": axis and
/// degrees; empty: none) and move_mm ("20 0 0"; empty: none).
/// @throws InputError  names the line and what is wrong: a name twice, `after` that is not the task
///                     on the line before or has another body, neither turn nor move.
[[nodiscard]] std::vector<Task> ReadTasks(const std::filesystem::path& path);

/// Tasks that follow each other, each `after` the one before it.
using Chain = std::vector<Task>;

/// In the tasks' order. @param only  shell patterns of names or groups, of which the chain has one
/// at least; none: all.
[[nodiscard]] std::vector<Chain> ChainsOf(const std::vector<Task>& tasks,
                                          const std::vector<std::string>& only);

}  // namespace regrasp::bench
