#pragma once

#include <string>

#include "planner/motion/proof_budget.h"
#include "planner/object/object.h"
#include "planner/plan/check.h"
#include "planner/plan/plan.h"
#include "planner/plan/rest_closure.h"

namespace regrasp::plan {

/// The faults of one step: the first of the report's order counts.
class StepFault {
 public:
  void Add(Reason reason, const std::string& detail, const Fault& fault = {});
  /// Whether a fault of this reason would count.
  [[nodiscard]] bool Wants(Reason reason) const {
    return reason_ == Reason::kNone || reason < reason_;
  }

  [[nodiscard]] bool none() const { return reason_ == Reason::kNone; }
  [[nodiscard]] Reason reason() const { return reason_; }
  [[nodiscard]] const std::string& detail() const { return detail_; }
  [[nodiscard]] const Fault& fault() const { return fault_; }

 private:
  Reason reason_ = Reason::kNone;
  std::string detail_;
  Fault fault_;
};

/// What every step is checked against. The plan is located (LocatePlan).
struct CheckContext {
  const object::Object& object;
  const Plan& plan;
  double half_angle;  ///< friction, radians
  RestClosure& rests;
  motion::ProofBudget& decisions;   ///< for deciding force closure along all aligns
  motion::ProofBudget& bounds;      ///< for the required half-angles of all aligns
  double finger_radius = 0;         ///< the object's unit of length; 0: points
  bool allow_undecided = false;     ///< CheckOptions
  bool judge_force_closure = true;  ///< CheckOptions

  [[nodiscard]] double tolerance() const { return object::kPointTolerance * object.diameter(); }

  /// Points are read to within the tolerance: fingers that overlap something by less don't.
  [[nodiscard]] double least_radius() const { return finger_radius - tolerance(); }
};

/// The checks of one entry of the report: reason, detail, force closure, required half-angle and
/// undecided intervals. Force closure is decided only where there is no other fault.
/// @param before  the grasp that holds before the step; it has passed.
[[nodiscard]] StepCheck CheckHold(const CheckContext& context);
[[nodiscard]] StepCheck CheckSwitch(const CheckContext& context, const FingerGrasp& before,
                                    const Switch& step);
/// The contacts stay: whether the hand can move them so is not asked here.
[[nodiscard]] StepCheck CheckMove(const CheckContext& context, const FingerGrasp& before);
[[nodiscard]] StepCheck CheckAlign(const CheckContext& context, const FingerGrasp& before,
                                   const Align& step);

}  // namespace regrasp::plan
