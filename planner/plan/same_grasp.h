#pragma once

#include "planner/grasp/contact.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// True iff points are within `tolerance` of each other and normals within kNormalTolerance.
[[nodiscard]] bool AreSameContact(const grasp::Contact& a, const grasp::Contact& b,
                                  double tolerance);

/// True iff the contacts of two grasps can be paired so that each pair is the same contact, in any
/// order. A maximum matching: within tolerance one contact may fit several.
[[nodiscard]] bool AreSameGrasp(const grasp::Grasp& a, const grasp::Grasp& b, double tolerance);

/// True iff the same fingers, in the same order, have the same bits of point, normal and torsion.
[[nodiscard]] bool AreIdentical(const FingerGrasp& a, const FingerGrasp& b);

}  // namespace regrasp::plan
