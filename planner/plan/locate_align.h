#pragma once

#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// Places the contacts of an align on the object, as LocateContact does. Where a contact lies on
/// several faces that its normal cannot tell apart (at a vertex between collinear edges, for
/// instance) each finger's faces are chosen so that its motion from waypoint to waypoint has the
/// fewest faults (FindMotionFault), then by the nearest normals.
void LocateAlign(const object::Object& object, Align& align);

}  // namespace regrasp::plan
