#include "apps/plan_object.h"

#include "planner/base/error.h"
#include "planner/base/number.h"

namespace regrasp::apps {

void CheckPlanFits(const plan::Plan& plan, const object::ObjectFile& object,
                   const PlanAndObject& given) {
  if (plan.dimension != object.object->dimension()) {
    throw InputError(given.plan_path + ": /object/dimension: " + std::to_string(plan.dimension) +
                     ", but " + given.object_path + " has dimension " +
                     std::to_string(object.object->dimension()));
  }
  if (plan.object_sha256 != object.sha256 && !given.allow_object_change) {
    throw InputError(given.plan_path +
                     ": /object/sha256: the plan was made for an object with digest " +
                     plan.object_sha256 + ", but " + given.object_path + " has " + object.sha256 +
                     " (--allow-object-change accepts it)");
  }
  if (given.scale && *given.scale != plan.scale) {
    throw InputError("--scale " + FormatDouble(*given.scale) + ": the plan's scale is " +
                     FormatDouble(plan.scale));
  }
}

}  // namespace regrasp::apps
