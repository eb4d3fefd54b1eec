#pragma once

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "planner/plan/reason.h"
#include "planner/plan/snapshot.h"

namespace regrasp::plan {

/// What a frame can show of an entry that was not replayed: the object at rest, and the fingers
/// where the plan has them, contacts as they are given, without forces. Of an align it is the
/// instant of the fault, or else its end.
///
/// Contacts may be anywhere, and fingers outside the hand; of a hostile file no more than
/// kMostDrawnFingers are told, those at fault first.
/// @param located             on the object as far as it fits (PlanCheck::located).
/// @param entry               0 the hold, k the k-th step.
/// @param fingertip_radius_m  metres.
[[nodiscard]] Snapshot MakePlannedSnapshot(const Plan& located, int entry, const Fault& fault,
                                           double fingertip_radius_m);

inline constexpr int kMostDrawnFingers = 16;

}  // namespace regrasp::plan
