#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "planner/base/deadline.h"
#include "planner/planning/in_hand_task.h"
#include "sim/actuation/simulate_execution.h"

namespace regrasp::apps {

/// Options of `plan` for a hand.
struct HandOptions {
  std::string hand;  ///< file of the hand; empty: fingers without a hand
  std::string turn;
  std::string start_pose;
  std::string goal_pose;
  std::string goal_facing;
  std::string goal_tolerance;
  std::string goals;              ///< file of goals; empty: none
  std::string gravity;            ///< direction, or any; empty: that of the hand
  std::optional<double> mass_kg;  ///< mass of the object; nullopt: the density of water
  bool gravity_support = false;   ///< whether grasps may hold the object by its weight
  bool rolls = false;             ///< whether fingertips roll in in-hand motions
  std::string continue_plan;      ///< plan whose end is the start; empty: none
  double clearance_m = 1e-3;
  /// Required robustness, and the conditions of the simulated execution.
  struct Robustness {
    planning::RobustnessLevel level = planning::RobustnessLevel::kRequired;
    sim::PlanningRobustness conditions = sim::PlanningRobustness::kNominal;
  };
  Robustness robustness;

  void AddTo(CLI::App& app);

  [[nodiscard]] bool given() const { return !hand.empty(); }
  /// Start and goal of `plan`.
  struct Ends {
    bool has_start = false;
    bool has_goal = false;
    bool starts_at_hand_grasp = false;
    bool ends_at_hand_grasp = false;
  };
  /// Check that the options are consistent.
  /// @throws InputError  if a task is missing or stated twice.
  void Check(const Ends& ends) const;
  /// Return the tolerance of the goal pose.
  /// @throws InputError  if the option is malformed.
  [[nodiscard]] plan::PoseTolerance GoalTolerance() const;
  /// Fill in the task.
  /// @throws InputError  if an option is malformed.
  void AskFor(planning::InHandTask& task) const;
};

}  // namespace regrasp::apps
