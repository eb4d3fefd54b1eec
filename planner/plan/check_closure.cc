#include "planner/plan/check_closure.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/object/polyhedron.h"

namespace regrasp::plan {

const StaticGraspClosure::Found& StaticGraspClosure::Of(const FingerGrasp& grasp) {
  if (AreIdentical(grasp, last_)) return found_;
  last_ = grasp;
  found_ = {};
  if (grasp.empty()) return found_;
  const grasp::Grasp contacts = ContactsOf(grasp);
  found_.required = grasp::ComputeRequiredFrictionAngle(contacts, frame_);
  found_.holds = grasp::IsForceClosure(contacts, frame_, friction_angle_);
  if (found_.holds && found_.required) {
    found_.required->lower = std::min(found_.required->lower, friction_angle_);
    found_.required->upper = std::min(found_.required->upper, friction_angle_);
  }
  return found_;
}

std::optional<grasp::RequiredFrictionAngle> Larger(
    const std::optional<grasp::RequiredFrictionAngle>& a,
    const std::optional<grasp::RequiredFrictionAngle>& b) {
  if (!a || !b) return std::nullopt;
  return grasp::RequiredFrictionAngle{std::max(a->lower, b->lower), std::max(a->upper, b->upper)};
}

std::string AngleNeeded(const CheckContext& context,
                        const std::optional<grasp::RequiredFrictionAngle>& required) {
  if (!required) return "is not force closure at any friction";
  const auto [needed, available] =
      FormatRequiredDegrees(Degrees(required->upper), Degrees(context.friction_angle));
  return "is not force closure: requires a friction angle of " + needed + "°, found " + available +
         "°";
}

Fault LossOfClosure(const CheckContext& context, const FingerGrasp& grasp,
                    const std::optional<grasp::RequiredFrictionAngle>& required) {
  Fault fault;
  fault.grasp = grasp;
  if (required) fault.required = required->upper;
  fault.friction_angle = context.friction_angle;
  return fault;
}

void LeaveUnproved(const std::string& why, const Fault& where, StepCheck& check, StepFault& fault) {
  check.force_closure = false;
  fault.Add(Reason::kNotProved, why, where);
}

namespace {

/// Include a static grasp with the normals of its contact patches, if the plan has a patch radius.
void IncludePatches(const CheckContext& context, const FingerGrasp& grasp, const std::string& name,
                    StepCheck& check, StepFault& fault) {
  const auto* solid = dynamic_cast<const object::Polyhedron*>(&context.object);
  const std::optional<double>& radius = context.plan.patch_radius;
  if (!radius || solid == nullptr) return;
  grasp::Grasp felt = ContactsOf(grasp);
  for (grasp::Contact& contact : felt) {
    contact.n = object::PatchNormal(*solid, contact.face, contact.p, *radius);
  }
  const object::WrenchFrame frame = context.object.wrench_frame();
  if (grasp::IsForceClosure(felt, frame, context.friction_angle)) return;
  const auto required = grasp::ComputeRequiredFrictionAngle(felt, frame);
  check.force_closure = false;
  fault.Add(Reason::kNotForceClosure,
            name + ", with the mean normals within " + FormatLength(*radius * context.plan.scale) +
                " of its contacts, " + AngleNeeded(context, required),
            LossOfClosure(context, grasp, required));
}

/// Include a grasp that is not force closure, if it is gravity-supported.
/// @param path  states of the hand while it holds the object with this grasp.
/// @returns whether it is.
bool IncludeSupported(const CheckContext& context, const FingerGrasp& grasp,
                      std::span<const HandState> path, StepCheck& check) {
  if (context.carrier == nullptr || path.empty() || grasp.empty()) return false;
  const grasp::Grasp contacts = ContactsOf(grasp);
  std::vector<Eigen::Isometry3d> poses;
  for (const HandState& state : path) poses.push_back(state.pose);
  if (!context.carrier->HoldsAlong(contacts, poses)) return false;
  check.force_closure = false;
  check.is_supported = true;
  for (const Eigen::Isometry3d& pose : poses) {
    check.required =
        Larger(check.required, context.carrier->RequiredFrictionAngleAt(contacts, pose));
    const double resistance = context.carrier->ResistanceAt(contacts, pose).lower;
    check.resistance = std::min(resistance, check.resistance.value_or(resistance));
  }
  return true;
}

/// Return the note of a grasp that is neither force closure nor gravity-supported.
std::string NotSupportedText(const CheckContext& context, const FingerGrasp& grasp,
                             std::span<const HandState> path) {
  if (context.carrier == nullptr || path.empty() || grasp.empty()) return "";
  double least = std::numeric_limits<double>::infinity();
  for (const HandState& state : path) {
    least = std::min(least, context.carrier->ResistanceAt(ContactsOf(grasp), state.pose).lower);
  }
  return "; with the object's weight it resists disturbances of " + FormatShort(least, 2) +
         " weights, expected at least " + FormatShort(context.carrier->support().disturbance);
}

}  // namespace

bool IncludeRest(const CheckContext& context, const FingerGrasp& grasp, const char* name,
                 std::span<const HandState> path, StepCheck& check, StepFault& fault) {
  if (!context.judge_force_closure) return false;
  const auto& [holds, required] = context.static_grasps.Of(grasp);
  if (!holds && IncludeSupported(context, grasp, path, check)) return true;
  check.required = Larger(check.required, required);
  check.force_closure = check.force_closure && holds;
  if (!holds) {
    fault.Add(Reason::kNotForceClosure,
              std::string(name) + " " + AngleNeeded(context, required) +
                  NotSupportedText(context, grasp, path),
              LossOfClosure(context, grasp, required));
  } else if (!required) {
    LeaveUnproved(std::string(name) + ": no required friction angle below 90° is proved",
                  LossOfClosure(context, grasp, required), check, fault);
  }
  if (holds) IncludePatches(context, grasp, name, check, fault);
  return false;
}

}  // namespace regrasp::plan
