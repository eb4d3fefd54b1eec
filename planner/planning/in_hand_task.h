#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/index.h"

namespace regrasp::kinematics {
struct HandModel;
}

namespace regrasp::plan {
struct Plan;
enum class Reason;
}  // namespace regrasp::plan

namespace regrasp::planning {

/// A turn of an object about one of its own axes.
struct Turn {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< of length 1, in the object's frame
  double angle = 0;                                 ///< radians
};

/// Whether a plan for a hand is to have something to spare, so that motors can carry it out: forces
/// well inside their cones, better grasps, more clearance, grasps that hold where their contacts
/// have rolled to, and no slides, whose drag the fingers that hold can seldom balance. Where plans
/// are tried (InHandTask::simulate) what counts is that the hand carries one out.
enum class Reserve {
  kNone,       ///< is not looked for
  kPreferred,  ///< is looked for, for a while, where there is a plan; not at any length
  kRequired,   ///< or there is no plan
};

/// How far a hand carries a plan out.
struct ExecutionResult {
  bool is_held = false;   ///< the start grasp, before the first step
  int steps = 0;          ///< that pass before one fails, or all
  bool is_whole = false;  ///< the plan's last rest is come to
  double spare = 0;       ///< of a whole one: the least share of a limit that is left, all along
  bool is_cut_short = false;  ///< the time was up before a step failed
  plan::Reason reason = {};   ///< of the step that failed; none (the first) where none did
  std::string detail = {};    ///< of it, for people: which finger or link, by how much
};

/// What is asked of a hand beside start and goal grasps: that the object turns, or goes to a pose.
/// Poses are of the object's own frame (its file's axes and origin) in the palm's, metres.
struct InHandTask {
  const kinematics::HandModel* hand = nullptr;  ///< outlives the task
  double scale = 1;                             ///< metres per unit of the object's file
  Reserve reserve = Reserve::kPreferred;
  double margin = 1e-3;  ///< between links, palm and object, metres
  Turn turn = {};        ///< about the object's centre, which may end some millimetres away
  std::optional<Eigen::Isometry3d> start_pose = {};  ///< none: where the hand's reach is best
  std::optional<Eigen::Isometry3d> goal_pose = {};   ///< instead of a turn
  /// That hold the contacts of a given start grasp, in its order; none: whichever can.
  std::vector<FingerIndex> start_fingers = {};
  /// Where reserve is looked for: how far the hand carries a plan out, nullopt where that can't be
  /// told, until the deadline (sim/actuation/simulate_execution.h); as many threads ask as the
  /// request has jobs. None: reserve is all that is asked for.
  std::function<std::optional<ExecutionResult>(const plan::Plan&, const Deadline&)> simulate = {};
};

}  // namespace regrasp::planning
