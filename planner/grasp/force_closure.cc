#include "planner/grasp/force_closure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/grasp/force_closure_core.h"

namespace regrasp::grasp {
namespace {

/// Nothing is known of the margin.
constexpr ForceClosure kUnknown{Decision::kTooClose, -1.0, std::numeric_limits<double>::infinity()};

/// Contacts closer to each other than this, over the radius of the grasp, are so few of the
/// frame's digits apart that nearly all directions between them look like one.
constexpr double kResolved = 1e-7;

/// Whether some contacts are apart, and yet too close to each other beside the grasp's radius.
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
                              double half_angle) {
  CheckGrasp(contacts, frame);
  CheckHalfAngle(half_angle);
  const object::WrenchFrame own = ContactFrame(contacts, frame.dimension);
  if (!(own.radius > 0)) {
    // Soft fingers at one point may resist every torque: no frame is left to decide it in. Points
    // may also be so close that the squares of their distances are 0.
    const bool soft = std::ranges::any_of(contacts, [](const Contact& c) { return c.torsion > 0; });
    if (soft || !Coincide(contacts)) return kUnknown;
    return {Decision::kNo, -1.0, -std::numeric_limits<double>::min()};
  }
  if (!std::isfinite(own.radius)) return kUnknown;
  UnitContacts units = MakeUnitContacts(contacts, own);
  SetUnitForces(units, half_angle);
  const ForceClosure answer =
      frame.dimension == 3 ? DecideForceClosure<6>(units) : DecideForceClosure<3>(units);
  const bool unsure = answer.decision == Decision::kNo && IsUnresolved(contacts, own.radius);
  return unsure ? kUnknown : answer;
}

bool IsForceClosure(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                    double half_angle) {
  return TestForceClosure(contacts, frame, half_angle).decision == Decision::kYes;
}

}  // namespace regrasp::grasp
