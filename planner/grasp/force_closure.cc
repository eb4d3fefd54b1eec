#include "planner/grasp/force_closure.h"

#include <algorithm>
#include <limits>

#include "planner/grasp/force_closure_core.h"

namespace regrasp::grasp {

ForceClosure TestForceClosure(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                              double half_angle) {
  CheckGrasp(contacts, frame);
  CheckHalfAngle(half_angle);
  const object::WrenchFrame own = ContactFrame(contacts, frame.dimension);
  if (!(own.radius > 0)) {
    // Soft fingers at one point may resist every torque: no frame is left to decide it in.
    const bool soft = std::ranges::any_of(contacts, [](const Contact& c) { return c.torsion > 0; });
    if (soft) return {Decision::kTooClose, -1.0, std::numeric_limits<double>::infinity()};
    return {Decision::kNo, -1.0, -std::numeric_limits<double>::min()};
  }
  UnitContacts units = MakeUnitContacts(contacts, own);
  SetUnitForces(units, half_angle);
  return frame.dimension == 3 ? DecideForceClosure<6>(units) : DecideForceClosure<3>(units);
}

bool IsForceClosure(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                    double half_angle) {
  return TestForceClosure(contacts, frame, half_angle).decision == Decision::kYes;
}

}  // namespace regrasp::grasp
