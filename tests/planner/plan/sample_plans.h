#pragma once

#include "planner/plan/plan.h"

namespace regrasp::plan {

// Plans that pass, from which the tests derive plans that fail.

/// Return a plan on MakeCube().
/// Fingers hold ±x and ±z. Finger 4 is placed on +y and finger 2 is lifted. Finger 2 is placed on
/// −y and finger 3 is lifted. Then all four slide, fingers 2 and 4 in two segments. Friction 30°,
/// five fingers.
Plan CubePlan();

/// Return a plan on MakeSquare().
/// Fingers hold below and above. Fingers 2 and 3 are placed right and left, and 0 and 1 are lifted.
/// Then both slide up. Friction 20°, four fingers.
Plan SquarePlan();

/// Return a plan with a sha256, a scale and other data, but without contacts and steps.
Plan EmptyPlan(int dimension, int fingers, double friction_angle_deg);

}  // namespace regrasp::plan
