#include "planner/grasp/force_closure.h"

#include <limits>

#include "planner/grasp/force_closure_core.h"

namespace regrasp::grasp {

ForceClosure TestForceClosure(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                              double half_angle) {
  CheckGrasp(contacts, frame);
  CheckHalfAngle(half_angle);
  const object::WrenchFrame own = ContactFrame(contacts, frame.dimension);
  if (!(own.radius > 0)) return {Decision::kNo, -1.0, -std::numeric_limits<double>::min()};
  UnitContacts units = MakeUnitContacts(contacts, own);
  SetUnitForces(units, half_angle);
  return frame.dimension == 3 ? DecideForceClosure<6>(units) : DecideForceClosure<3>(units);
}

bool IsForceClosure(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                    double half_angle) {
  return TestForceClosure(contacts, frame, half_angle).decision == Decision::kYes;
}

}  // namespace regrasp::grasp
