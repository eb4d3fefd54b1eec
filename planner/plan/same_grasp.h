#pragma once

#include "planner/grasp/contact.h"

namespace regrasp::plan {

/// True iff points are within `tolerance` of each other and normals within kNormalTolerance.
[[nodiscard]] bool AreSameContact(const grasp::Contact& a, const grasp::Contact& b,
                                  double tolerance);

/// True iff the contacts of two grasps can be paired so that each pair is the same contact, in any
/// order. A maximum matching: within tolerance one contact may fit several.
[[nodiscard]] bool AreSameGrasp(const grasp::Grasp& a, const grasp::Grasp& b, double tolerance);

}  // namespace regrasp::plan
