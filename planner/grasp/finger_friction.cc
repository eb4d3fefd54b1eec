#include "planner/grasp/finger_friction.h"

#include <cmath>
#include <numbers>

#include "planner/grasp/force_closure.h"
#include "planner/grasp/force_closure_core.h"
#include "planner/grasp/required_half_angle.h"

namespace regrasp::grasp {

namespace {

/// Half-angles are found to this, radians: far below a hundredth of a degree, far above rounding.
constexpr double kTolerance = 1e-9;

/// Fingers whose half-angles differ by less count as equally weak.
constexpr double kEqual = 1e-7;

bool Decide(const UnitContacts& contacts, int dimension) {
  const ForceClosure answer =
      dimension == 3 ? DecideForceClosure<6>(contacts) : DecideForceClosure<3>(contacts);
  return answer.decision == Decision::kYes;
}

std::optional<double> RequiredWithout(std::span<const Contact> contacts, std::size_t finger,
                                      const object::WrenchFrame& frame) {
  Grasp rest(contacts.begin(), contacts.end());
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(finger));
  const auto required = ComputeRequiredHalfAngle(rest, frame, kTolerance);
  return required ? std::optional<double>(required->upper) : std::nullopt;
}

/// Negative where `a` is weaker than `b`, positive where it is stronger, 0 where they are equal.
int Compare(const FingerFriction& a, const FingerFriction& b) {
  const double none = std::numbers::pi / 2;
  for (const double more :
       {a.required - b.required, a.without.value_or(none) - b.without.value_or(none)}) {
    if (std::abs(more) > kEqual) return more > 0 ? -1 : 1;
  }
  return 0;
}

/// Halves the interval between no friction and all of it.
double FindRequired(UnitContacts contacts, std::size_t finger, int dimension, double half_angle) {
  double lower = 0, upper = half_angle;
  while (upper - lower > kTolerance) {
    const double middle = lower + (upper - lower) / 2;
    contacts[finger].axial = std::cos(middle);
    contacts[finger].tangential = std::sin(middle);
    (Decide(contacts, dimension) ? upper : lower) = middle;
  }
  return upper;
}

}  // namespace

std::vector<FingerFriction> MeasureFingerFriction(std::span<const Contact> contacts,
                                                  const object::WrenchFrame& frame,
                                                  double half_angle) {
  if (!IsForceClosure(contacts, frame, half_angle)) return {};
  UnitContacts units = MakeUnitContacts(contacts, ContactFrame(contacts, frame.dimension));
  SetUnitForces(units, half_angle);
  std::vector<FingerFriction> fingers;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const std::optional<double> without = RequiredWithout(contacts, i, frame);
    const bool needed = !without || *without > half_angle;
    const double required = needed ? FindRequired(units, i, frame.dimension, half_angle) : 0;
    fingers.push_back({required, needed, without});
  }
  return fingers;
}

int WeakestFinger(const std::vector<FingerFriction>& fingers) {
  int weakest = -1;
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    if (weakest < 0 || Compare(fingers[i], fingers[weakest]) < 0) {
      weakest = static_cast<int>(i);
    }
  }
  return weakest;
}

}  // namespace regrasp::grasp
