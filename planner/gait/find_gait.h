#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/criteria/grasp_criteria.h"
#include "planner/gait/gait.h"
#include "planner/gait/home.h"
#include "planner/kinematics/hand_model.h"
#include "planner/object/polyhedron.h"
#include "planner/planning/plan_request.h"

namespace regrasp::gait {

/// Whether a gait is to have something to spare, so that motors can carry it out: friction, better
/// grasps, more clearance, grasps that hold where their contacts have rolled to, and no slides,
/// whose drag the fingers that hold can seldom balance.
enum class Reserve {
  kNone,       ///< is not looked for
  kPreferred,  ///< is looked for, for a while, where there is a gait; not at any length
  kRequired,
};

/// What is asked of a hand: that the object turns, or goes to a pose, or is held by another grasp
/// in the end, or both. Poses are of the object's own frame (its file's axes and origin) in the
/// palm's, metres.
struct GaitRequest {
  const kinematics::HandModel* hand = nullptr;
  const object::Polyhedron* solid = nullptr;
  double scale = 1;  ///< metres per unit of the solid's file
  criteria::GraspCriteria criteria;
  Reserve reserve = Reserve::kPreferred;
  double margin = 1e-3;  ///< between links, palm and object, metres
  Turn turn;             ///< about the object's centre, which may end some millimetres away
  std::optional<Eigen::Isometry3d> start_pose;  ///< none: where the hand's reach is best
  std::optional<Eigen::Isometry3d> goal_pose;   ///< instead of a turn
  grasp::Grasp start_grasp;                     ///< in the file's units; empty: any
  grasp::Grasp goal_grasp;                      ///< the same
  std::uint64_t seed = 0;
  std::int64_t most_expanded = 8'000;  ///< rests, from all places in the hand together
  Deadline deadline = {};
  planning::Progress progress = [](std::string_view) {};
};

struct GaitResult {
  std::optional<Gait> gait;
  std::vector<grasp::Contact> contacts;  ///< by the numbers that the gait has, the object's units
  std::string message;                   ///< where there is none: what stopped it, counted
};

/// The fingers that grasps of a request are judged for: as many as the hand has, each with its
/// largest tip. Lengths in the object's unit.
[[nodiscard]] hand::Hand FingersOf(const GaitRequest& request);

/// Finds a gait of the hand that turns the object: chooses where in the hand it begins and with
/// which grasp. A preferred reserve is left out where the gait gets much longer by it.
///
/// Laws: without a deadline the same request gives the same gait, bit for bit; every rest is force
/// closure and meets the criteria where it can; every path is certified (certified_path.h).
[[nodiscard]] GaitResult FindGait(const GaitRequest& request);

}  // namespace regrasp::gait
