#pragma once

#include <optional>
#include <string>

#include "planner/grasp/contact.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/motion/find_motion_proof.h"
#include "planner/object/object.h"
#include "planner/object/wrench_frame.h"
#include "planner/plan/check.h"
#include "planner/plan/gravity_support.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// Evaluate force closure of the static grasps of a plan in sequence.
/// Caches the last grasp, because the last grasp of a step is the first grasp of the next step.
class StaticGraspClosure {
 public:
  struct Found {
    bool holds = false;
    /// At most the friction angle if the grasp is force closure; nullopt if no friction angle is
    /// enough.
    std::optional<grasp::RequiredFrictionAngle> required;
  };

  /// @param friction_angle  friction angle in radians.
  StaticGraspClosure(const object::WrenchFrame& frame, double friction_angle)
      : frame_(frame), friction_angle_(friction_angle) {}

  /// Return the force closure of a grasp.
  /// @param grasp  located grasp; without contacts it is not force closure.
  [[nodiscard]] const Found& Of(const FingerGrasp& grasp);

 private:
  object::WrenchFrame frame_;
  double friction_angle_;
  FingerGrasp last_;
  Found found_;  ///< result for the last grasp
};

/// Return the fault of a motion between two contacts on the object; nullopt if there is none.
/// A motion has no fault in two cases. The contact stays on one face throughout. Or it keeps its
/// point (to within kPointTolerance · D) and changes from one face to another at a point that both
/// have in common. Faces that are merely near each other, on both sides of a thin wall or of a
/// slit, have no common point.
[[nodiscard]] std::optional<std::string> FindMotionFault(const object::Object& object,
                                                         const grasp::Contact& from,
                                                         const grasp::Contact& to);

/// Fault of one step: of several faults, the first in the order of the report.
class StepFault {
 public:
  void Add(Reason reason, const std::string& detail, const Fault& fault = {});
  /// Return whether a fault of this reason would replace the current one.
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

/// Context of the checks of all steps. The plan is located (ProjectPlan).
struct CheckContext {
  const object::Object& object;
  const Plan& plan;
  double friction_angle;  ///< friction angle, radians
  StaticGraspClosure& static_grasps;
  motion::ProofBudget& decisions;  ///< budget for deciding force closure along all sliding steps
  motion::ProofBudget& bounds;     ///< budget for the required friction angles of all sliding steps
  double finger_radius = 0;        ///< radius in the object's unit of length; 0: points
  bool allow_undecided = false;    ///< as in CheckOptions
  bool judge_force_closure = true;         ///< as in CheckOptions
  const WeightCarrier* carrier = nullptr;  ///< null: every grasp must be force closure
  const HandState* state = nullptr;        ///< state before the step; null without a hand

  [[nodiscard]] double tolerance() const { return object::kPointTolerance * object.diameter(); }

  /// Finger radius reduced by the tolerance of points.
  /// Overlaps smaller than the tolerance therefore do not count.
  [[nodiscard]] double least_radius() const { return finger_radius - tolerance(); }
};

/// Check one entry of the report.
/// Sets reason, detail, force closure, required friction angle and undecided intervals. Force
/// closure is decided only if there is no other fault.
/// @param before  grasp before the step, which has passed.
[[nodiscard]] StepCheck CheckHold(const CheckContext& context);
[[nodiscard]] StepCheck CheckSwitch(const CheckContext& context, const FingerGrasp& before,
                                    const Switch& step);
/// Check an in-hand motion. If fingertips roll, every grasp of it is on the surface and force
/// closure. Whether they roll without slipping depends on the hand (sim/hand/check_hand.h). If
/// contacts are fixed, the hand's motion is checked only for whether gravity keeps the object on
/// the fingers.
[[nodiscard]] StepCheck CheckMove(const CheckContext& context, const FingerGrasp& before,
                                  const Move& step);
[[nodiscard]] StepCheck CheckAlign(const CheckContext& context, const FingerGrasp& before,
                                   const Align& step);

}  // namespace regrasp::plan
