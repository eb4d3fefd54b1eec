#pragma once

#include "planner/plan/plan.h"

namespace regrasp::plan {

// Plans that pass, from which the tests make plans that fail.

/// On MakeCube(): hold ±x and ±z; place finger 4 on +y, lift finger 2; place finger 2 on −y, lift
/// finger 3; then all four slide, fingers 2 and 4 in two pieces. Friction 30°, five fingers.
Plan CubePlan();

/// On MakeSquare(): hold below and above; place fingers 2 and 3 right and left, lift 0 and 1; then
/// both slide up. Friction 20°, four fingers.
Plan SquarePlan();

/// A plan with a sha256, a scale and so on, but neither contacts nor steps.
Plan EmptyPlan(int dimension, int fingers, double half_angle_deg);

}  // namespace regrasp::plan
