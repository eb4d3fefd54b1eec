#include "planner/grasp/required_half_angle.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "planner/grasp/cone_support.h"
#include "planner/grasp/force_closure_core.h"

namespace regrasp::grasp {
namespace {

/// Friction beyond this is not looked for: the header's 1e-6 rad below π/2.
constexpr double kLargestHalfAngle = std::numbers::pi / 2 - 1e-6;

/// The bracket halves at every step, so that 64 steps are more than any tolerance needs.
constexpr int kMaxSteps = 64;

/// Around an angle that is too close to call, certain ones are looked for this many times farther
/// at every step.
constexpr double kWiden = 4;

template <int kDim>
class Bracket {
 public:
  Bracket(UnitContacts& contacts, double tolerance) : contacts_(contacts), tolerance_(tolerance) {}

  std::optional<RequiredHalfAngle> Find() {
    if (Decide(kLargestHalfAngle) != Decision::kYes) return std::nullopt;
    for (int step = 0; step < kMaxSteps && bounds_.upper - bounds_.lower > tolerance_; ++step) {
      const double middle = bounds_.lower + (bounds_.upper - bounds_.lower) / 2;
      switch (Decide(middle)) {
        case Decision::kYes:
          bounds_.upper = middle;
          break;
        case Decision::kNo:
          bounds_.lower = middle;
          break;
        case Decision::kTooClose:
          CloseIn(middle);
          return bounds_;
      }
    }
    return bounds_;
  }

 private:
  Decision Decide(double half_angle) {
    if (half_angle <= refuted_) return Decision::kNo;
    SetUnitForces(contacts_, half_angle);
    typename WrenchSimplex<kDim>::Vector twist;
    const Decision decision = DecideForceClosure<kDim>(contacts_, nullptr, &twist).decision;
    if (decision == Decision::kNo) RefuteUpTo(twist);
    return decision;
  }

  /// A twist that separates at one angle often does so at larger ones, too.
  void RefuteUpTo(const typename WrenchSimplex<kDim>::Vector& twist) {
    double angle = kLargestHalfAngle;
    for (const UnitContact& contact : contacts_) {
      angle = std::min(angle, HeldOffHalfAngle<kDim>(contact, twist.data()));
    }
    refuted_ = std::max(refuted_, angle - kClearlyRefuted);
  }

  void CloseIn(double half_angle) {
    for (double d = tolerance_ / kWiden; half_angle - d > bounds_.lower; d *= kWiden) {
      if (Decide(half_angle - d) == Decision::kNo) bounds_.lower = half_angle - d;
    }
    for (double d = tolerance_ / kWiden; half_angle + d < bounds_.upper; d *= kWiden) {
      if (Decide(half_angle + d) == Decision::kYes) bounds_.upper = half_angle + d;
    }
  }

  UnitContacts& contacts_;
  double tolerance_;
  double refuted_ = 0;  ///< up to this half-angle some twist separates
  RequiredHalfAngle bounds_{0, kLargestHalfAngle};
};

}  // namespace

std::optional<RequiredHalfAngle> ComputeRequiredHalfAngle(std::span<const Contact> contacts,
                                                          const object::WrenchFrame& frame,
                                                          double tolerance) {
  CheckGrasp(contacts, frame);
  if (!(tolerance > 0)) throw std::invalid_argument("required half-angle: tolerance not positive");
  const object::WrenchFrame own = ContactFrame(contacts, frame.dimension);
  if (!(own.radius > 0)) return std::nullopt;
  UnitContacts units = MakeUnitContacts(contacts, own);
  return frame.dimension == 3 ? Bracket<6>(units, tolerance).Find()
                              : Bracket<3>(units, tolerance).Find();
}

}  // namespace regrasp::grasp
