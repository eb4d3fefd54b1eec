#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/index.h"
#include "planner/plan/goal_set.h"
#include "planner/plan/plan.h"

namespace regrasp::kinematics {
struct HandModel;
}

namespace regrasp::plan {
enum class Reason;
}  // namespace regrasp::plan

namespace regrasp::planning {

/// A rotation of an object about one of its own axes.
struct Turn {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector in the object frame
  double angle = 0;                                 ///< radians
};

/// Whether a plan for a hand must have robustness margins, so that actuators can execute it.
///
/// The margins are forces well inside their cones, better grasps, more clearance, grasps that stay
/// force closure after their contacts roll, and no sliding steps, because the other fingers can
/// rarely balance the drag. With InHandTask::simulate, a plan must execute in simulation instead.
enum class RobustnessLevel {
  kNone,       ///< no margins
  kPreferred,  ///< searched for a limited time, then a plan without them
  kRequired,   ///< margins required
};

/// Execution of a plan under several conditions, such as sensor errors or other friction.
struct RobustnessRating {
  int conditions = 0;                    ///< number of conditions
  std::vector<std::string> failed = {};  ///< names of the conditions under which the plan fails

  [[nodiscard]] int passed() const { return conditions - static_cast<int>(failed.size()); }
};

/// Grasp force of a static grasp, which is the sum of its normal forces, newtons.
struct GraspForceNeed {
  double weight = 0;     ///< weight of the object
  double required = 0;   ///< least force that supports the weight with a force margin
  double available = 0;  ///< largest force within the permitted share of the actuators' limits
};

/// How far a hand executes a plan in simulation.
struct ExecutionResult {
  bool is_held = false;   ///< whether the start grasp is held before the first step
  int steps = 0;          ///< number of steps before the first failure, or all
  bool is_whole = false;  ///< whether the last static grasp of the plan is reached
  double tolerance_margin =
      0;  ///< if is_whole: smallest tolerance margin, as a fraction of its limit
  bool is_cut_short = false;  ///< whether the deadline passed before a step failed
  plan::Reason reason = {};   ///< reason of the failed step; the first reason (none) if none failed
  std::string detail = {};    ///< description of the failure: finger or link, and by how much
  std::optional<RobustnessRating> rating = {};  ///< of a whole execution, if it was rated
  std::optional<GraspForceNeed> force = {};     ///< of the failed step, if it was measured
};

/// An object task for a hand, in addition to start and goal grasp: rotate the object, or move it to
/// a pose of a goal set. Poses are those of the object frame (axes and origin of its file) in the
/// palm frame, metres.
struct InHandTask {
  const kinematics::HandModel* hand = nullptr;  ///< outlives the task
  double scale = 1;                             ///< metres per unit of the object's file
  RobustnessLevel robustness = RobustnessLevel::kPreferred;
  double margin = 1e-3;  ///< smallest clearance between links, palm and object, metres
  Turn turn = {};        ///< about the object's centre, which may end a few millimetres away
  std::optional<Eigen::Isometry3d> start_pose =
      {};                                  ///< nullopt: the pose that the hand reaches best
  std::optional<plan::GoalSet> goal = {};  ///< poses at the end, instead of a turn
  /// Goals that the object reaches one after the other, instead of a turn and a goal.
  std::vector<plan::NamedGoal> goals = {};
  /// Tolerance of a turn: of its angle, and of the position of the object's centre. Without it the
  /// angle is exact and the centre may end some millimetres away.
  std::optional<plan::PoseTolerance> turn_tolerance = {};
  /// Unit vectors against gravity in the palm frame. The planner uses the first one with which it
  /// finds a plan. Empty: that of the hand.
  std::vector<Eigen::Vector3d> ups = {};
  /// Set if grasps may hold the object by its weight instead of force closure.
  std::optional<plan::GravitySupport> gravity_support = {};
  /// Mass of the object in simulation, kg; nullopt: that of the density of water.
  std::optional<double> mass_kg = {};
  /// Whether fingertips roll in in-hand motions (plan::Move::contacts). If not, their contacts are
  /// fixed in the plan, and a real fingertip deviates from them.
  bool rolls = false;
  /// Fingers of the contacts of a given start grasp, in its order; empty: any fingers.
  std::vector<FingerIndex> start_fingers = {};
  /// Joint angles [finger][joint] at the start, radians (plan::HandState::joints); empty: any.
  /// Requires `start_pose` and `start_fingers`.
  std::vector<std::vector<double>> start_joints = {};
  /// Fingers of the contacts of a given goal grasp, in its order; empty: any fingers.
  std::vector<FingerIndex> goal_fingers = {};
  /// Simulates the execution of a plan until the deadline (sim/actuation/simulate_execution.h).
  /// Returns nullopt if the hand has no actuators. Called only if `robustness` is not kNone, by as
  /// many threads as the request has jobs. Empty: plans are not simulated.
  std::function<std::optional<ExecutionResult>(const plan::Plan&, const Deadline&)> simulate = {};
  /// Rates a plan that executes (sim/actuation/simulate_execution.h), called like `simulate` if the
  /// plan with the largest margin is requested. Returns nullopt if more than `most_failures`
  /// conditions fail or the deadline passes. Empty: plans are not rated.
  std::function<std::optional<RobustnessRating>(const plan::Plan&, int most_failures,
                                                const Deadline&)>
      rate = {};
  /// Measures the grasp force of the static grasp after a number of steps of a plan
  /// (sim/actuation/simulate_execution.h). Called for the best candidate if none executes. Empty:
  /// forces are not measured.
  std::function<std::optional<GraspForceNeed>(const plan::Plan&, int steps)> measure_force = {};
};

}  // namespace regrasp::planning
