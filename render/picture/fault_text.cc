#include "render/picture/fault_text.h"

#include "planner/base/angle.h"
#include "planner/base/number.h"
#include "planner/grasp/angle_between.h"
#include "render/picture/round_length.h"

namespace regrasp::render {

namespace {

using plan::Fault;
using plan::Reason;

constexpr int kLengthDigits = 3;
constexpr int kForceDigits = 2;
constexpr int kAngleDecimals = 2;

/// Normals that differ by less are told apart by their length.
constexpr double kTold = Radians(0.05);

bool IsPaired(const Fault& fault) {
  return !fault.fingers.empty() && fault.found && fault.expected.size() == 1;
}

std::string Under(const Fault& fault) {
  return fault.push ? " under " + PushText(*fault.push) : "";
}

/// Of a finger that is not where it should be.
std::string MisplacedText(Reason reason, const Fault& fault, const std::string& detail,
                          double metres_per_unit) {
  const std::string finger = "finger " + std::to_string(fault.fingers.front());
  const grasp::Contact& expected = fault.expected.front();
  const std::string distance =
      FormatLength((fault.found->p - expected.p).stableNorm() * metres_per_unit, kLengthDigits);
  const double angle = grasp::AngleBetween(fault.found->n, expected.n);
  switch (reason) {
    case Reason::kOffSurface:
    case Reason::kContactLost:
      return finger + " is " + distance + " off the surface" + Under(fault);
    case Reason::kSlipped:
      return finger + " slipped by " + distance + Under(fault);
    case Reason::kWrongNormal:
      return angle > kTold ? "the normal of " + finger + " is off by " + FormatDegrees(angle)
                           : detail;
    case Reason::kDiscontinuous:
      return finger + " is " + distance + " from where it was" +
             (angle > kTold ? ", turned by " + FormatDegrees(angle) : "");
    default:
      return detail;
  }
}

std::string ClosureText(const Fault& fault) {
  if (!fault.required) return "the grasp is force closure at no friction";
  return "the grasp needs " + FormatDegrees(*fault.required) + ", has " +
         FormatDegrees(fault.half_angle.value_or(0));
}

}  // namespace

std::string FormatDegrees(double radians) {
  return FormatFixed(Degrees(radians), kAngleDecimals) + "°";
}

std::string PushText(const plan::FaultPush& push) {
  const double force = push.force_N.norm();
  return force > 0 ? "a push of " + FormatShort(force, kForceDigits) + " N"
                   : "a twist of " + FormatShort(push.torque_Nm.norm(), kForceDigits) + " N·m";
}

std::string FaultText(Reason reason, const Fault& fault, const std::string& detail,
                      double metres_per_unit) {
  if (IsPaired(fault)) return MisplacedText(reason, fault, detail, metres_per_unit);
  if (reason == Reason::kNotForceClosure) return ClosureText(fault);
  if (reason == Reason::kObjectMoved && fault.X_WO_before) {
    return "the object moved by " + FormatLength(fault.moved_m, kLengthDigits) + " and turned by " +
           FormatDegrees(fault.turned) + Under(fault);
  }
  return detail;
}

}  // namespace regrasp::render
