#pragma once

#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/gait/gait.h"
#include "planner/gait/hand_scene.h"
#include "planner/kinematics/finger_kinematics.h"

namespace regrasp::gait {

/// Permitted proximity of each fingertip to the object [finger].
using Touching = std::vector<TipContact>;

/// Certify that hand and object keep the margin between two consecutive keyframes.
/// Conservative advancement: an interval is accepted if its midpoint clears the motion bound, and
/// is halved otherwise. Touching fingertips may penetrate the surface by kTipDepth.
[[nodiscard]] bool IsClear(const HandScene& scene, const Keyframe& from, const Keyframe& to,
                           const Touching& touching);

/// Certify the motion of one finger while everything else is stationary.
/// @param from, to  joint configurations of the finger; interpolated linearly.
/// @param pose  object pose in the palm's frame.
/// @param tip  permitted proximity of the fingertip.
/// @param others  all other fingers, as placed.
[[nodiscard]] bool IsClear(const HandScene& scene, FingerIndex finger,
                           const JointConfiguration& from, const JointConfiguration& to,
                           const Eigen::Isometry3d& pose, TipContact tip,
                           const std::vector<PlacedFinger>& others);

/// Path of one finger: joint configurations, interpolated linearly.
using FingerPath = std::vector<JointConfiguration>;

/// Stationary scene while one finger moves.
struct Surroundings {
  Eigen::Isometry3d pose;            ///< object pose in the palm's frame
  std::vector<PlacedFinger> others;  ///< all other fingers
  /// All other fingers with their fingertips rolled (rolling.h). Empty if rolling is not modelled.
  std::vector<PlacedFinger> rolled = {};
};

/// Return the scene of all fingers except one, as placed in a keyframe.
[[nodiscard]] Surroundings AllExcept(const HandScene& scene, FingerIndex moving,
                                     const Keyframe& frame);

/// Plan a certified path of an idle finger between two joint configurations.
/// Uses RRT-Connect (Kuffner and LaValle 2000) in joint space, followed by shortcutting.
/// @param most_extensions  maximum number of extensions of both trees, about 0.1 ms each [default:
///     100].
/// @returns the path; nullopt if none is found.
[[nodiscard]] std::optional<FingerPath> FindFreePath(const HandScene& scene, FingerIndex finger,
                                                     const JointConfiguration& from,
                                                     const JointConfiguration& to,
                                                     const Surroundings& around,
                                                     RandomStream& random,
                                                     int most_extensions = 100);

/// Plan a certified path that lifts a fingertip off its contact.
/// Lifts along the surface normal as far as the finger reaches; if that fails, along a tilted
/// direction.
/// @param target  fingertip target at the contact.
/// @param touching  joint configuration at the contact.
/// @returns the path; nullopt if the fingertip does not reach a height from which it can move
///     freely.
[[nodiscard]] std::optional<FingerPath> FindLiftPath(const HandScene& scene,
                                                     const kinematics::InverseKinematics& inverse,
                                                     FingerIndex finger,
                                                     const kinematics::TipTarget& target,
                                                     const JointConfiguration& touching,
                                                     const Surroundings& around);

/// Plan a certified path of an idle finger to a contact.
/// Consists of a free path to the end of the lift path (FindLiftPath) and the reversed lift path.
/// @param from  joint configuration of the idle finger.
/// @param target  fingertip target at the contact.
/// @param touching  joint configuration at the contact.
/// @returns the path; nullopt if none is found.
[[nodiscard]] std::optional<FingerPath> FindPathToContact(
    const HandScene& scene, const kinematics::InverseKinematics& inverse, FingerIndex finger,
    const JointConfiguration& from, const kinematics::TipTarget& target,
    const JointConfiguration& touching, const Surroundings& around, RandomStream& random);

}  // namespace regrasp::gait
