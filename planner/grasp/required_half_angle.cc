#include "planner/grasp/required_half_angle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "planner/grasp/force_closure_core.h"

namespace regrasp {
namespace {

/// Friction beyond this is not looked for: the header's 1e-6 rad below π/2.
constexpr double kLargestHalfAngle = std::numbers::pi / 2 - 1e-6;

/// The bracket halves at every step, so that 64 steps are more than any tolerance needs.
constexpr int kMaxSteps = 64;

template <int kDim>
std::optional<RequiredHalfAngle> Bracket(UnitContacts& contacts, double tolerance) {
  const auto decide = [&](double half_angle) {
    SetUnitForces(contacts, half_angle);
    return DecideForceClosure<kDim>(contacts).decision;
  };
  if (decide(kLargestHalfAngle) != Decision::kYes) return std::nullopt;
  RequiredHalfAngle bounds{0, kLargestHalfAngle};
  for (int step = 0; step < kMaxSteps && bounds.upper - bounds.lower > tolerance; ++step) {
    const double middle = bounds.lower + (bounds.upper - bounds.lower) / 2;
    const Decision decision = decide(middle);
    if (decision == Decision::kTooClose) break;
    (decision == Decision::kYes ? bounds.upper : bounds.lower) = middle;
  }
  return bounds;
}

}  // namespace

std::optional<RequiredHalfAngle> ComputeRequiredHalfAngle(std::span<const Contact> contacts,
                                                          const WrenchFrame& frame,
                                                          double tolerance) {
  CheckGrasp(contacts, frame);
  if (!(tolerance > 0)) throw std::invalid_argument("required half-angle: tolerance not positive");
  const WrenchFrame own = ContactFrame(contacts, frame.dimension);
  if (!(own.radius > 0)) return std::nullopt;
  UnitContacts units = MakeUnitContacts(contacts, own);
  return frame.dimension == 3 ? Bracket<6>(units, tolerance) : Bracket<3>(units, tolerance);
}

}  // namespace regrasp
