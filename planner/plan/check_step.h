#pragma once

#include <optional>
#include <string>

#include "planner/grasp/contact.h"
#include "planner/grasp/required_half_angle.h"
#include "planner/motion/find_motion_proof.h"
#include "planner/object/object.h"
#include "planner/object/wrench_frame.h"
#include "planner/plan/check.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// Force closure of the grasps at rest of a plan, one after the other: what one step ends with the
/// next one begins with, and is not decided twice.
class RestClosure {
 public:
  struct Found {
    bool holds = false;
    /// No larger than the friction where the grasp holds; nullopt where no half-angle is enough.
    std::optional<grasp::RequiredHalfAngle> required;
  };

  /// @param half_angle  friction, radians.
  RestClosure(const object::WrenchFrame& frame, double half_angle)
      : frame_(frame), half_angle_(half_angle) {}

  /// @param grasp  located, or without contacts: it does not hold then.
  [[nodiscard]] const Found& Of(const FingerGrasp& grasp);

 private:
  object::WrenchFrame frame_;
  double half_angle_;
  FingerGrasp last_;
  Found found_;  ///< of that
};

/// What is wrong with a motion between two contacts that lie on the object: nullopt where the
/// contact stays on one face all the way, or keeps its point (to within kPointTolerance · D) and
/// turns from one face to another at a point that both have in common. Faces that are merely near
/// each other, on the two sides of a thin wall or of a slit, have none.
[[nodiscard]] std::optional<std::string> FindMotionFault(const object::Object& object,
                                                         const grasp::Contact& from,
                                                         const grasp::Contact& to);

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
