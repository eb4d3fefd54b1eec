#include "planner/plan/reason.h"

namespace regrasp::plan {

std::string_view ReasonName(Reason reason) {
  switch (reason) {
    case Reason::kNone:
      return "";
    case Reason::kOffSurface:
      return "off-surface";
    case Reason::kWrongNormal:
      return "wrong-normal";
    case Reason::kFingerNotFree:
      return "finger-not-free";
    case Reason::kFingerNotHolding:
      return "finger-not-holding";
    case Reason::kTooManyFingers:
      return "too-many-fingers";
    case Reason::kCoincidentFingers:
      return "coincident-fingers";
    case Reason::kDiscontinuous:
      return "discontinuous";
    case Reason::kLeavesFace:
      return "leaves-face";
    case Reason::kNotForceClosure:
      return "not-force-closure";
    case Reason::kNotProved:
      return "not-proved";
    case Reason::kUnreachable:
      return "unreachable";
    case Reason::kOffPoint:
      return "off-point";
    case Reason::kHandJumps:
      return "hand-jumps";
    case Reason::kTipOffContact:
      return "tip-off-contact";
    case Reason::kJointLimit:
      return "joint-limit";
    case Reason::kHandCollides:
      return "hand-collides";
    case Reason::kTorqueLimit:
      return "torque-limit";
    case Reason::kCouplingViolated:
      return "coupling-violated";
    case Reason::kTipPenetrates:
      return "tip-penetrates";
    case Reason::kSimulationUnstable:
      return "simulation-unstable";
    case Reason::kContactLost:
      return "contact-lost";
    case Reason::kSlipped:
      return "slipped";
    case Reason::kObjectMoved:
      return "object-moved";
    case Reason::kNotStatic:
      return "not-static";
    case Reason::kStartDiffers:
      return "start-differs";
    case Reason::kGoalNotReached:
      return "goal-not-reached";
  }
  return "";
}

}  // namespace regrasp::plan
