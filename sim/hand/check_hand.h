#pragma once

#include <filesystem>
#include <vector>

#include "planner/kinematics/hand_file.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/check.h"
#include "planner/plan/plan.h"

namespace regrasp::sim {

struct HandCheckOptions {
  double clearance_m = 1e-3;  ///< minimum gap between links, palm and object
};

/// Check that a hand can execute its plan, independently of the planner's methods.
/// It uses the engine's kinematics, and the Frank-Wolfe method for distances. The checks are:
///
/// - Consecutive states are continuous, and each has all joints of the hand.
/// - In every state, joints are within their limits, and coupled joints match their coupling to
///   1e-6 rad.
/// - Fingertips in contact are at their contacts: within 1e-6 m in static grasps, within 1e-4 m
///   during in-hand motions and sliding steps. Placed fingers end at their contacts.
/// - No link is closer to another link, to the palm or to the object than the clearance, anywhere
///   on the paths. This is certified by a bound on motion between samples. A fingertip in contact,
///   or about to be, may touch the object and penetrate it by up to 0.3 mm. The collision geometry
///   that a fingertip sphere replaces counts for links and palm, not for the object.
/// - The object ends at the goal pose of the plan, and is in each goal set that the plan marks.
///
/// @param plan  plan with a hand, located (plan::ProjectPlan).
/// @returns the first fault of each entry that has one. Later entries are checked as if the earlier
///     ones were valid. A fault names the finger, the joint or the links, the value and the limit,
///     and has a place that can be drawn. Links that are too close are reported at their smallest
///     gap on the path.
/// @throws InputError  if the hand is not the one of the plan.
[[nodiscard]] std::vector<plan::HandFault> CheckHand(const kinematics::HandFile& file,
                                                     const object::Polyhedron& solid,
                                                     const plan::Plan& plan,
                                                     const HandCheckOptions& options = {});

/// Check that the hand of a file can execute its plan.
/// @throws InputError  if the hand cannot be read, or is not the one of the plan.
[[nodiscard]] std::vector<plan::HandFault> CheckHand(const std::filesystem::path& hand_file,
                                                     const object::Polyhedron& solid,
                                                     const plan::Plan& plan,
                                                     const HandCheckOptions& options = {});

}  // namespace regrasp::sim
