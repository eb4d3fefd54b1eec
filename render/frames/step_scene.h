#pragma once

#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "render/frames/body_shape.h"
#include "render/frames/gltf.h"

namespace regrasp::render {

/// An entry of a plan as a scene in space, metres, in the object's frame: the object as glass, and
/// for each finger its ball, stem and friction cone, its arrow or its track, as frames draw them,
/// without forces. Names are "object", "finger 0", "finger 0 cone" ...
/// @param located  the plan on this object (LocatePlan).
/// @param entry    0 the hold, k the k-th step.
[[nodiscard]] std::vector<ScenePart> MakeStepScene(const object::Object& object,
                                                   const plan::Plan& located,
                                                   plan::EntryIndex entry,
                                                   const BodyOptions& options = {});

}  // namespace regrasp::render
