#include "planner/grasp/required_friction_angle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "planner/grasp/cone_support.h"
#include "planner/grasp/force_closure_core.h"
#include "planner/grasp/friction_search.h"

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
    throw std::invalid_argument("required friction angle: tolerance not positive");
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

}  // namespace regrasp::grasp
