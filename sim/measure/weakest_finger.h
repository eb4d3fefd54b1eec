#pragma once

#include <vector>

#include "planner/object/wrench_frame.h"
#include "planner/plan/plan.h"
#include "sim/scene/measured.h"

namespace regrasp::sim {

/// What every finger of the grasps of an entry needs, at rest: of the hold the initial grasp, of a
/// switch the grasps before and after it, of an align the grasps at its waypoints. A finger that
/// holds in several of them has an element for each. Empty for an entry without contacts.
/// @param located  contacts on the surface, in the unit of `frame`.
[[nodiscard]] std::vector<NeedOfFinger> NeedsOfEntry(const plan::Plan& located,
                                                     plan::EntryIndex index,
                                                     const object::WrenchFrame& frame,
                                                     double half_angle);

/// Index of the finger with the least of its own friction to spare, as planner/grasp/
/// finger_friction.h has it; −1 for none.
[[nodiscard]] int WeakestOf(const std::vector<NeedOfFinger>& needs);

/// The grasps of an entry, in the order of time (see NeedsOfEntry).
[[nodiscard]] std::vector<plan::FingerGrasp> GraspsOfEntry(const plan::Plan& located,
                                                           plan::EntryIndex index);

}  // namespace regrasp::sim
