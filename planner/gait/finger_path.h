#pragma once

#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/gait/gait.h"
#include "planner/gait/hand_scene.h"
#include "planner/kinematics/inverse_kinematics.h"

namespace regrasp::gait {

/// What touches the object, by finger.
using Touching = std::vector<TipContact>;

/// Whether hand and object keep the margin all the way from a keyframe to the next one: certified,
/// at samples so dense that nothing comes nearer between them than the motion's bound allows.
/// Fingers that touch may be in the surface by kTipDepth.
[[nodiscard]] bool IsClear(const HandScene& scene, const Keyframe& from, const Keyframe& to,
                           const Touching& touching);

/// The same for one finger that moves while all else stands still.
/// @param others  all other fingers, as they stand.
[[nodiscard]] bool IsClear(const HandScene& scene, FingerIndex finger, const Posture& from,
                           const Posture& to, const Eigen::Isometry3d& pose, TipContact tip,
                           const std::vector<PlacedFinger>& others);

/// Where a finger goes, posture by posture; between them its drives go straight.
using FingerPath = std::vector<Posture>;

/// All that stands still while one finger moves.
struct Surroundings {
  Eigen::Isometry3d pose;            ///< of the object
  std::vector<PlacedFinger> others;  ///< all other fingers
  /// These where their tips have rolled to (rolling.h), all of them again; none: they have not.
  std::vector<PlacedFinger> rolled = {};
};

/// All but one finger, as they stand.
[[nodiscard]] Surroundings AllBut(const HandScene& scene, FingerIndex moving,
                                  const Keyframe& frame);

/// A certified path of a free finger between two postures, by RRT-Connect (Kuffner and LaValle
/// 2000) over its drives, then shortened.
/// @param most_extensions  of its two trees; each a tenth of a millisecond or so.
/// @returns nullopt where none was found.
[[nodiscard]] std::optional<FingerPath> FindFreePath(const HandScene& scene, FingerIndex finger,
                                                     const Posture& from, const Posture& to,
                                                     const Surroundings& around,
                                                     RandomStream& random,
                                                     int most_extensions = 100);

/// A certified path from a contact up along the normal, as high as the finger goes, or, where that
/// is no way, aslant to a side.
/// @param target    of the tip at the contact.
/// @param touching  the posture there.
/// @returns none where it does not come far enough off the surface to go elsewhere.
[[nodiscard]] std::optional<FingerPath> FindLiftPath(
    const HandScene& scene, const kinematics::InverseKinematics& inverse, FingerIndex finger,
    const kinematics::TipTarget& target, const Posture& touching, const Surroundings& around);

/// A certified path from a free posture to a contact: freely to a place some millimetres above it,
/// then down as by FindLiftPath.
/// @param target   of the tip at the contact.
/// @param touching the posture there.
[[nodiscard]] std::optional<FingerPath> FindPathToContact(
    const HandScene& scene, const kinematics::InverseKinematics& inverse, FingerIndex finger,
    const Posture& from, const kinematics::TipTarget& target, const Posture& touching,
    const Surroundings& around, RandomStream& random);

}  // namespace regrasp::gait
