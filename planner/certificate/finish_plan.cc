#include "planner/certificate/finish_plan.h"

#include "planner/certificate/align_certificate.h"

namespace regrasp::certificate {

plan::PlanCheck FinishPlan(const object::ObjectFile& object, const PlanOrigin& origin,
                           plan::Plan& plan) {
  plan.object_file = object.file;
  plan.object_sha256 = object.sha256;
  plan.repair = object.repair;
  plan.shells = origin.shells;
  plan.patch_radius = origin.patch_radius;
  plan.at_given_points = origin.given_points != nullptr;
  plan.half_angle = origin.half_angle;
  plan.scale = origin.scale;
  AddCertificates(*object.object, plan);
  plan::CheckOptions options;
  options.given_points = origin.given_points;
  return plan::CheckPlan(*object.object, plan, options);
}

}  // namespace regrasp::certificate
