#pragma once

#include <filesystem>
#include <vector>

#include "planner/kinematics/hand_file.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/check.h"
#include "planner/plan/plan.h"

namespace regrasp::sim {

struct HandCheckOptions {
  double clearance_m = 1e-3;  ///< that links keep from each other, from palm and object
};

/// Checks that a hand can carry out its plan, by other means than those that planned it: the
/// engine's kinematics, and the Frank-Wolfe method for what is near each other. Asked are:
///
/// - states that follow each other without a jump, each with all joints of the hand;
/// - joints within their limits, and coupled joints at what they are coupled to, to 1e-6 rad, in
///   every state;
/// - tips at the contacts of the fingers that hold: within 1e-6 m at rest, 1e-4 m in moves and
///   aligns; and ended there, those that are placed;
/// - no link nearer to another one, to the palm or to the object than the clearance, everywhere
///   along the paths: certified by a bound on how far things move between samples. A tip that
///   holds, or is about to, may touch the object, and be in it by 0.3 mm;
/// - the object at last where the plan says that it is to be.
///
/// @param plan  located (plan::LocatePlan), with a hand.
/// @returns the first fault of each entry that has one; later entries are looked at as if the ones
///          before them were right.
/// A fault names the finger, the joint or the links, with the number and what is allowed, and has a
/// place that can be drawn; links that are too near are told where the path brings them nearest.
/// @throws InputError  the hand is not the one that the plan was made for.
[[nodiscard]] std::vector<plan::HandFault> CheckHand(const kinematics::HandFile& file,
                                                     const object::Polyhedron& solid,
                                                     const plan::Plan& plan,
                                                     const HandCheckOptions& options = {});

/// The same of a hand's file.
/// @throws InputError  the hand cannot be read, too.
[[nodiscard]] std::vector<plan::HandFault> CheckHand(const std::filesystem::path& hand_file,
                                                     const object::Polyhedron& solid,
                                                     const plan::Plan& plan,
                                                     const HandCheckOptions& options = {});

}  // namespace regrasp::sim
