#include "planner/plan/rest_closure.h"

#include <algorithm>

#include "planner/grasp/force_closure.h"
#include "planner/plan/same_grasp.h"

namespace regrasp::plan {

const RestClosure::Found& RestClosure::Of(const FingerGrasp& grasp) {
  if (AreIdentical(grasp, last_)) return found_;
  last_ = grasp;
  found_ = {};
  if (grasp.empty()) return found_;
  const grasp::Grasp contacts = ContactsOf(grasp);
  found_.required = grasp::ComputeRequiredHalfAngle(contacts, frame_);
  found_.holds = grasp::IsForceClosure(contacts, frame_, half_angle_);
  if (found_.holds && found_.required) {
    found_.required->lower = std::min(found_.required->lower, half_angle_);
    found_.required->upper = std::min(found_.required->upper, half_angle_);
  }
  return found_;
}

}  // namespace regrasp::plan
