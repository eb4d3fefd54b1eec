#include "planner/grasp/required_friction_angle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "planner/grasp/cone_support.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/force_closure_core.h"

namespace regrasp::grasp {

namespace {

/// Largest friction angle of the search: 1e-6 rad below π/2, as in the header.
constexpr double kLargestFrictionAngle = std::numbers::pi / 2 - 1e-6;

/// Limit on bisection steps. The bracket halves at every step, so any tolerance needs fewer.
constexpr int kMaxSteps = 64;

/// Growth factor per step of the distance from an undecidable angle at which the search evaluates
/// the next angles.
constexpr double kWiden = 4;

/// Bracket between an angle that is too small and one that is enough.
template <int kDim>
class Bracket {
 public:
  Bracket(UnitContacts contacts, double tolerance)
      : search_(std::move(contacts)), tolerance_(tolerance) {}

  std::optional<RequiredFrictionAngle> Find() {
    if (search_.Decide(kLargestFrictionAngle) != Decision::kYes) return std::nullopt;
    return Narrow({0, kLargestFrictionAngle});
  }

  RequiredFrictionAngle Narrow(const RequiredFrictionAngle& known) {
    bounds_ = known;
    for (int step = 0; step < kMaxSteps && bounds_.upper - bounds_.lower > tolerance_; ++step) {
      const double middle = bounds_.lower + (bounds_.upper - bounds_.lower) / 2;
      switch (search_.Decide(middle)) {
        case Decision::kYes:
          bounds_.upper = middle;
          break;
        case Decision::kNo:
          bounds_.lower = middle;
          break;
        case Decision::kTooClose:
          CloseIn(middle);
          Confirm(known);
          return bounds_;
      }
    }
    Confirm(known);
    return bounds_;
  }

 private:
  /// Confirm without reuse a decision that used columns of other angles.
  /// Near the required angle one of the two decisions may be too close to call.
  void Confirm(const RequiredFrictionAngle& known) {
    double d = tolerance_ / kWiden;
    while (bounds_.upper < known.upper && search_.DecideAlone(bounds_.upper) != Decision::kYes) {
      bounds_.upper = std::min(bounds_.upper + d, known.upper);
      d *= kWiden;
    }
    d = tolerance_ / kWiden;
    while (bounds_.lower > known.lower && search_.DecideAlone(bounds_.lower) != Decision::kNo) {
      bounds_.lower = std::max(bounds_.lower - d, known.lower);
      d *= kWiden;
    }
  }

  void CloseIn(double friction_angle) {
    for (double d = tolerance_ / kWiden; friction_angle - d > bounds_.lower; d *= kWiden) {
      if (search_.Decide(friction_angle - d) == Decision::kNo) bounds_.lower = friction_angle - d;
    }
    for (double d = tolerance_ / kWiden; friction_angle + d < bounds_.upper; d *= kWiden) {
      if (search_.Decide(friction_angle + d) == Decision::kYes) bounds_.upper = friction_angle + d;
    }
  }

  FrictionSearch<kDim> search_;
  double tolerance_;
  RequiredFrictionAngle bounds_;
};

/// Return the result of `find` for the bracket of a grasp; nullopt if all contacts coincide.
template <class Find>
std::optional<RequiredFrictionAngle> WithBracket(std::span<const Contact> contacts,
                                                 const object::WrenchFrame& frame, double tolerance,
                                                 const Find& find) {
  CheckGrasp(contacts, frame);
  if (!(tolerance > 0))
    throw std::invalid_argument("required friction angle: the tolerance must be positive");
  const object::WrenchFrame own = ContactFrame(contacts, frame.dimension);
  if (!(own.radius > 0)) return std::nullopt;
  const UnitContacts units = MakeUnitContacts(contacts, own);
  if (frame.dimension == 3) {
    Bracket<6> bracket(units, tolerance);
    return find(bracket);
  }
  Bracket<3> bracket(units, tolerance);
  return find(bracket);
}

}  // namespace

std::optional<RequiredFrictionAngle> ComputeRequiredFrictionAngle(std::span<const Contact> contacts,
                                                                  const object::WrenchFrame& frame,
                                                                  double tolerance) {
  return WithBracket(contacts, frame, tolerance, [](auto& bracket) { return bracket.Find(); });
}

RequiredFrictionAngle NarrowRequiredFrictionAngle(std::span<const Contact> contacts,
                                                  const object::WrenchFrame& frame,
                                                  const RequiredFrictionAngle& known,
                                                  double tolerance) {
  const auto narrow = [&](auto& bracket) -> std::optional<RequiredFrictionAngle> {
    return bracket.Narrow(known);
  };
  return WithBracket(contacts, frame, tolerance, narrow).value_or(known);
}

namespace {

/// Tolerance of friction angles, radians: much less than a hundredth of a degree, much more than
/// rounding.
constexpr double kTolerance = 1e-9;

/// Difference of friction angles below which fingers count as equally weak, radians.
constexpr double kEqual = 1e-7;

/// Upper bound on the distance between bounds on required friction angles.
constexpr double kBoundsApart = 1e-6;

/// Substitute for the friction angle if no angle is enough.
constexpr double kNone = std::numbers::pi / 2;

Grasp Without(std::span<const Contact> contacts, std::size_t finger) {
  Grasp rest(contacts.begin(), contacts.end());
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(finger));
  return rest;
}

std::optional<double> RequiredWithout(std::span<const Contact> contacts, std::size_t finger,
                                      const object::WrenchFrame& frame) {
  const auto required = ComputeRequiredFrictionAngle(Without(contacts, finger), frame, kTolerance);
  return required ? std::optional<double>(required->upper) : std::nullopt;
}

/// Return whether `a` is weaker than `b`.
bool IsWeaker(const FingerFriction& a, const FingerFriction& b) {
  const double more = a.required - b.required;
  if (std::abs(more) > kEqual) return more > 0;
  return a.without.value_or(kNone) - b.without.value_or(kNone) > kEqual;
}

/// Find the friction angle that a finger of a force-closure grasp requires itself.
/// All others keep theirs. Bisects between 0 and the finger's own friction angle.
template <int kDim>
double FindRequired(FrictionSearch<kDim>& own, double friction_angle) {
  double lower = 0, upper = friction_angle;
  while (upper - lower > kTolerance) {
    const double middle = lower + (upper - lower) / 2;
    (own.Decide(middle) == Decision::kYes ? upper : lower) = middle;
  }
  return upper;
}

template <int kDim>
std::vector<FingerFriction> MeasureAll(std::span<const Contact> contacts, const UnitContacts& units,
                                       const object::WrenchFrame& frame, double friction_angle) {
  std::vector<FingerFriction> fingers;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const std::optional<double> without = RequiredWithout(contacts, i, frame);
    const bool needed = !without || *without > friction_angle;
    FrictionSearch<kDim> own(units, i);
    fingers.push_back({needed ? FindRequired(own, friction_angle) : 0, needed, without});
  }
  return fingers;
}

/// Search for the weakest finger, one finger after the other.
template <int kDim>
class WeakestSearch {
 public:
  WeakestSearch(std::span<const Contact> contacts, const UnitContacts& units,
                const object::WrenchFrame& frame, double friction_angle)
      : contacts_(contacts), units_(units), frame_(frame), friction_angle_(friction_angle) {}

  WeakFinger Find() {
    for (std::size_t i = 0; i < contacts_.size(); ++i) Include(i);
    weakest_.friction.without = WithoutWeakest();
    return weakest_;
  }

 private:
  void Include(std::size_t i) {
    const bool needed = !IsForceClosure(Without(contacts_, i), frame_, friction_angle_);
    FrictionSearch<kDim> own(units_, i);
    const auto holds = [&](double angle) { return own.Decide(angle) == Decision::kYes; };
    if (i > 0) {
      const double most = weakest_.friction.required + kEqual;
      const double least = weakest_.friction.required - kEqual;
      const bool needs_more = needed && most < friction_angle_ && !holds(most);
      if (!needs_more) {
        if (least > 0 && (!needed || holds(least))) return;
        if (!NeedMoreWithout(i)) return;
      }
    }
    const double required = needed ? FindRequired(own, friction_angle_) : 0;
    weakest_ = {static_cast<int>(i), {required, needed, std::nullopt}};
    without_known_ = false;
  }

  /// Return whether the others need more without this finger than without the weakest so far.
  bool NeedMoreWithout(std::size_t i) {
    const std::optional<double> known = WithoutWeakest();
    if (!known) return false;
    const double surely_less = *known - kBoundsApart;
    if (surely_less > 0 && IsForceClosure(Without(contacts_, i), frame_, surely_less)) return false;
    return RequiredWithout(contacts_, i, frame_).value_or(kNone) - *known > kEqual;
  }

  std::optional<double> WithoutWeakest() {
    if (!without_known_) {
      weakest_.friction.without = RequiredWithout(contacts_, weakest_.finger, frame_);
      without_known_ = true;
    }
    return weakest_.friction.without;
  }

  std::span<const Contact> contacts_;
  const UnitContacts& units_;
  const object::WrenchFrame& frame_;
  double friction_angle_;
  WeakFinger weakest_;
  bool without_known_ = false;
};

UnitContacts UnitContactsAt(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                            double friction_angle) {
  UnitContacts units = MakeUnitContacts(contacts, ContactFrame(contacts, frame.dimension));
  SetUnitForces(units, friction_angle);
  return units;
}

}  // namespace

std::vector<FingerFriction> MeasureFingerFriction(std::span<const Contact> contacts,
                                                  const object::WrenchFrame& frame,
                                                  double friction_angle) {
  if (!IsForceClosure(contacts, frame, friction_angle)) return {};
  const UnitContacts units = UnitContactsAt(contacts, frame, friction_angle);
  return frame.dimension == 3 ? MeasureAll<6>(contacts, units, frame, friction_angle)
                              : MeasureAll<3>(contacts, units, frame, friction_angle);
}

int WeakestFinger(const std::vector<FingerFriction>& fingers) {
  int weakest = -1;
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    if (weakest < 0 || IsWeaker(fingers[i], fingers[weakest])) weakest = static_cast<int>(i);
  }
  return weakest;
}

std::optional<WeakFinger> FindWeakestFinger(std::span<const Contact> contacts,
                                            const object::WrenchFrame& frame,
                                            double friction_angle) {
  if (!IsForceClosure(contacts, frame, friction_angle)) return std::nullopt;
  const UnitContacts units = UnitContactsAt(contacts, frame, friction_angle);
  return frame.dimension == 3 ? WeakestSearch<6>(contacts, units, frame, friction_angle).Find()
                              : WeakestSearch<3>(contacts, units, frame, friction_angle).Find();
}

}  // namespace regrasp::grasp
