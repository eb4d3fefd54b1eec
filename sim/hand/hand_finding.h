#pragma once

#include <span>
#include <string>
#include <vector>

#include "planner/plan/check.h"
#include "sim/hand/hand_body.h"

namespace regrasp::sim {

/// What a check of a hand finds wrong, told with numbers for people and with its place for a
/// picture. Each of these makes one kind of it; all lengths in metres, all angles in radians.
struct HandFinding {
  plan::Reason reason = plan::Reason::kNone;
  std::string detail;
  plan::Fault fault;
};

/// "finger 1 (middle)".
[[nodiscard]] std::string FingerText(const kinematics::HandModel& hand, FingerIndex finger);

/// A path or a state that does not fit the hand.
/// @param state  as the hand stood before.
[[nodiscard]] HandFinding NoSuchPath(const std::string& what, const plan::HandState& state);

/// A contact for a finger that the hand has not.
[[nodiscard]] HandFinding NoSuchFinger(FingerIndex finger, const plan::HandState& state);

/// The object is not where it was.
[[nodiscard]] HandFinding ObjectJumps(const plan::HandState& now, const Eigen::Isometry3d& before,
                                      const std::string& when);

/// The object is not where it is to be at last.
[[nodiscard]] HandFinding GoalMissed(const plan::HandState& last, const Eigen::Isometry3d& goal);

/// A joint is not where it was.
/// @param joint  of the finger, from the palm on.
[[nodiscard]] HandFinding JointJumps(HandBody& body, const plan::HandState& now, FingerIndex finger,
                                     int joint, double before);

/// @param when  "in state 3 of its path", or empty.
[[nodiscard]] HandFinding JointOutside(HandBody& body, const plan::HandState& state,
                                       FingerIndex finger, int joint, const std::string& when);

/// A joint that is not where its coupling has it.
/// @param most  residual that is allowed, radians.
[[nodiscard]] HandFinding JointUncoupled(HandBody& body, const plan::HandState& state,
                                         const HandBody::Uncoupled& uncoupled, double most,
                                         const std::string& when);

/// A tip that is not where it touches its contact.
/// @param expected   its centre there, in the palm's frame.
/// @param tolerance  how far it may be away.
[[nodiscard]] HandFinding TipOff(HandBody& body, const plan::HandState& state, FingerIndex finger,
                                 const Eigen::Vector3d& expected, double tolerance,
                                 const std::string& when);

/// Two parts of the hand that are too near to each other.
[[nodiscard]] HandFinding PartsCollide(HandBody& body, const plan::HandState& state, int a, int b,
                                       double clearance, const std::string& when);

/// A part of the hand that is too near to the object, or too deep in it.
/// @param surface  the object's triangles in its own frame, counter-clockwise from outside.
/// @param needed   how near it may be; negative: how deep.
[[nodiscard]] HandFinding PartMeetsObject(HandBody& body, const plan::HandState& state, int part,
                                          std::span<const ConvexBody> surface, double needed,
                                          const std::string& when);

/// How near two parts are, or a part and the object: as above, but for the depth.
[[nodiscard]] double GapBetween(HandBody& body, const plan::HandState& state, int a, int b);
[[nodiscard]] double GapToObject(HandBody& body, const plan::HandState& state, int part,
                                 std::span<const ConvexBody> surface);

}  // namespace regrasp::sim
