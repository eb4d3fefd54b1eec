#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/hand_bodies.h"
#include "planner/grasp/contact.h"
#include "planner/kinematics/hand_file.h"
#include "planner/plan/plan.h"
#include "planner/plan/reason.h"

namespace regrasp::bench {

/// Default friction coefficient of all contacts.
inline constexpr double kFriction = 0.8;

/// Cause of a failure, with the step and the measured value.
struct TrialFault {
  plan::Reason reason = plan::Reason::kNone;
  std::string detail;
};

/// Return the first fault found by the checkers of plans and of hands.
/// They use the plan's own friction, and no simulation.
[[nodiscard]] std::optional<TrialFault> CheckInHand(const kinematics::HandFile& hand,
                                                    const HandBody& body, const plan::Plan& plan);

/// Result of the replay of a plan by its hand, with disturbance tests. The object has the density
/// of water.
struct HandTrial {
  std::optional<TrialFault> fault;
  double simulated_s = 0;  ///< simulated time without the disturbance tests, s
  /// Static grasp before its disturbance test.
  struct Rest {
    grasp::Grasp contacts;  ///< actual contacts, in the unit of the object's file
    Eigen::Matrix3d turn;   ///< orientation of the object in the palm frame
  };
  std::vector<Rest> rests;
  double grasp_force_N = 0;
  // Final static grasp, before its disturbance test; nullopt if the replay does not reach it.
  std::optional<Eigen::Isometry3d> end;  ///< pose of the object
  double off_m = 0;                      ///< position deviation from the plan, m
  double off_rad = 0;
};

/// Replay a plan on the hand's own actuators (sim::ReplayHand) at kFriction.
/// @param friction_factor  true friction divided by the friction assumed by the hand.
[[nodiscard]] HandTrial TryInHand(const kinematics::HandFile& hand, const HandBody& body,
                                  const plan::Plan& plan, double friction_factor = 1);

/// Compute the required friction coefficient of the static grasps of a trial.
/// It is the least value at which their contacts can balance the weight and each force of the
/// disturbance test. With less friction no controller can keep the object in place. Force closure
/// may need more, if the weight keeps the object between the fingers.
[[nodiscard]] double RequiredFriction(const HandTrial& trial, const kinematics::HandModel& hand,
                                      const HandBody& body);

}  // namespace regrasp::bench
