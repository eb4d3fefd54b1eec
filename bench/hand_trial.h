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

/// Of all contacts, where nothing else is said.
inline constexpr double kFriction = 0.8;

/// Why a plan fails, with the step and the number.
struct TrialFault {
  plan::Reason reason = plan::Reason::kNone;
  std::string detail;
};

/// The first fault that the checkers of plans and of hands find at the plan's own friction, without
/// a simulation.
[[nodiscard]] std::optional<TrialFault> CheckInHand(const kinematics::HandFile& hand,
                                                    const HandBody& body, const plan::Plan& plan);

/// What a plan's replay by its hand comes to, for a body of the density of water, with shakes.
struct HandTrial {
  std::optional<TrialFault> fault;
  double simulated_s = 0;  ///< without the shakes
  /// A rest, before it is shaken.
  struct Rest {
    grasp::Grasp contacts;  ///< where they came to be, in the unit of the body's file
    Eigen::Matrix3d turn;   ///< of the body in the palm's frame
  };
  std::vector<Rest> rests;
  double squeeze_N = 0;
  // At the last rest, before it is shaken; none where the replay does not come there.
  std::optional<Eigen::Isometry3d> end;  ///< of the body
  double off_m = 0;                      ///< from where the plan has it
  double off_rad = 0;
};

/// Replays a plan on the hand's own actuators (sim::ReplayHand) at kFriction.
/// @param friction_factor  the world's friction over the one that the hand believes.
[[nodiscard]] HandTrial TryInHand(const kinematics::HandFile& hand, const HandBody& body,
                                  const plan::Plan& plan, double friction_factor = 1);

/// The least friction with which the contacts of all rests of a trial could balance the weight and
/// each push of the shake: with less the body can't stay there, whatever the hand does. Force
/// closure may need more, where the weight keeps the body between the fingers.
[[nodiscard]] double CriticalFriction(const HandTrial& trial, const kinematics::HandModel& hand,
                                      const HandBody& body);

}  // namespace regrasp::bench
