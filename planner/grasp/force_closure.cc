#include "planner/grasp/force_closure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/grasp/force_closure_core.h"

namespace regrasp::grasp {
namespace {

/// Result with an unknown margin.
constexpr ForceClosure kUnknown{Decision::kTooClose, -1.0, std::numeric_limits<double>::infinity()};

/// Distance between contacts, over the radius of the grasp, below which too few digits remain to
/// distinguish directions between them.
constexpr double kResolved = 1e-7;

/// Return whether two distinct contacts are too close to each other for the grasp's radius.
bool IsUnresolved(std::span<const Contact> contacts, double radius) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (std::size_t j = i + 1; j < contacts.size(); ++j) {
      const Eigen::Vector3d apart = contacts[i].p - contacts[j].p;
      const double distance = apart.lpNorm<Eigen::Infinity>();
      if (distance > 0 && !(distance >= kResolved * radius)) return true;
    }
  }
  return false;
}

bool Coincide(std::span<const Contact> contacts) {
  return std::ranges::all_of(contacts, [&](const Contact& c) { return c.p == contacts.front().p; });
}

}  // namespace

ForceClosure TestForceClosure(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                              double friction_angle) {
  CheckGrasp(contacts, frame);
  CheckFrictionAngle(friction_angle);
  const object::WrenchFrame own = ContactFrame(contacts, frame.dimension);
  if (!(own.radius > 0)) {
    // Soft fingers at one point may resist every torque, but there is no frame to decide it in. The
    // squares of the distances of very close points may also be 0.
    const bool soft = std::ranges::any_of(contacts, [](const Contact& c) { return c.torsion > 0; });
    if (soft || !Coincide(contacts)) return kUnknown;
    return {Decision::kNo, -1.0, -std::numeric_limits<double>::min()};
  }
  if (!std::isfinite(own.radius)) return kUnknown;
  UnitContacts units = MakeUnitContacts(contacts, own);
  SetUnitForces(units, friction_angle);
  const ForceClosure answer =
      frame.dimension == 3 ? DecideForceClosure<6>(units) : DecideForceClosure<3>(units);
  const bool unsure = answer.decision == Decision::kNo && IsUnresolved(contacts, own.radius);
  return unsure ? kUnknown : answer;
}

bool IsForceClosure(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                    double friction_angle) {
  return TestForceClosure(contacts, frame, friction_angle).decision == Decision::kYes;
}

}  // namespace regrasp::grasp
