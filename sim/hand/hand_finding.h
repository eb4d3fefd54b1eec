#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/plan/check.h"
#include "planner/plan/plan.h"
#include "sim/hand/hand_body.h"

namespace regrasp::sim {

/// Finding of a hand check: text with numbers for messages, and its place for an image. Each of the
/// functions below makes one kind of finding; all lengths are in metres, all angles in radians.
struct HandFinding {
  plan::Reason reason = plan::Reason::kNone;
  std::string detail;
  plan::Fault fault;
};

/// Return "finger 1 (middle)".
[[nodiscard]] std::string FingerText(const kinematics::HandModel& hand, FingerIndex finger);

/// Describe the difference of two hands by their names, or by their digests if the names are equal.
[[nodiscard]] std::string OtherHandText(const kinematics::HandModel& found,
                                        const plan::HandUse& expected);

/// Report a path or state that does not match the hand.
/// @param state  state of the hand before it.
[[nodiscard]] HandFinding NoSuchPath(const std::string& what, const plan::HandState& state);

/// Report a contact for a finger that the hand does not have.
[[nodiscard]] HandFinding NoSuchFinger(FingerIndex finger, const plan::HandState& state);

/// Report a discontinuous object pose.
[[nodiscard]] HandFinding ObjectJumps(const plan::HandState& now, const Eigen::Isometry3d& before,
                                      const std::string& when);

/// Report the first goal that the object does not reach after a step: one that the plan marks there
/// and whose set does not contain the object's pose, to 1e-6 m and 1e-6 rad, or after the last step
/// the final pose.
/// @param entry  number of the step; 0: the initial grasp.
/// @param state  state of the hand after the step.
/// @returns nullopt if all goals there are reached.
[[nodiscard]] std::optional<HandFinding> FindMissedGoal(const plan::Plan& plan, int entry,
                                                        const plan::HandState& state);

/// Report a discontinuous joint angle.
/// @param joint  joint of the finger, from the palm on.
[[nodiscard]] HandFinding JointJumps(HandBody& body, const plan::HandState& now, FingerIndex finger,
                                     int joint, double before);

/// Report a joint outside its limits.
/// @param when  "in state 3 of its path", or empty.
[[nodiscard]] HandFinding JointOutside(HandBody& body, const plan::HandState& state,
                                       FingerIndex finger, int joint, const std::string& when);

/// Report a joint that deviates from its coupling.
/// @param most  allowed residual, radians.
[[nodiscard]] HandFinding JointUncoupled(HandBody& body, const plan::HandState& state,
                                         const HandBody::Uncoupled& uncoupled, double most,
                                         const std::string& when);

/// Report a fingertip away from its contact.
/// @param expected   centre of the fingertip at its contact, in the palm's frame.
/// @param tolerance  allowed distance.
[[nodiscard]] HandFinding TipOff(HandBody& body, const plan::HandState& state, FingerIndex finger,
                                 const Eigen::Vector3d& expected, double tolerance,
                                 const std::string& when);

/// Report two parts of the hand that are too close to each other.
[[nodiscard]] HandFinding PartsCollide(HandBody& body, const plan::HandState& state, int a, int b,
                                       double clearance, const std::string& when);

/// Report a part of the hand that is too close to the object, or too deep in it.
/// @param surface  triangles of the object in its own frame, counter-clockwise from outside.
/// @param needed   required gap; negative: allowed depth.
[[nodiscard]] HandFinding PartMeetsObject(HandBody& body, const plan::HandState& state, int part,
                                          std::span<const ConvexBody> surface, double needed,
                                          const std::string& when);

/// Return the gap between two parts, or a part and the object, without the depth of overlaps.
[[nodiscard]] double GapBetween(HandBody& body, const plan::HandState& state, int a, int b);
[[nodiscard]] double GapToObject(HandBody& body, const plan::HandState& state, int part,
                                 std::span<const ConvexBody> surface);

}  // namespace regrasp::sim
