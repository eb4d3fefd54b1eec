#include "apps/plan_object.h"

#include "apps/repair_module.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"

namespace regrasp::apps {

namespace {

/// Return whether the plan is for this object or for its unrepaired original.
bool IsFor(const plan::Plan& plan, const object::ObjectFile& object) {
  if (plan.repair && !object.repair) return plan.repair->sha256 == object.sha256;
  return plan.object_sha256 == object.sha256 && plan.repair == object.repair;
}

std::string WrongObject(const plan::Plan& plan, const object::ObjectFile& object,
                        const PlanAndObject& given) {
  if (plan.object_sha256 == object.sha256 && plan.repair && object.repair) {
    return given.plan_path + ": /object/repair/sha256: expected " + object.repair->sha256 +
           ", the repaired solid of " + given.object_path + ", found " + plan.repair->sha256;
  }
  return given.plan_path + ": /object/sha256: the plan is for another object file, expected " +
         DescribeFile(plan.object_file, plan.object_sha256) + ", found " +
         DescribeFile(given.object_path, object.sha256);
}

}  // namespace

std::string DescribeFile(const std::string& name, const std::string& sha256) {
  constexpr std::size_t kShown = 12;
  return (name.empty() ? "a file" : name) + " (SHA-256 " + sha256.substr(0, kShown) +
         (sha256.size() > kShown ? "…)" : ")");
}

object::ObjectFile ReadObjectOf(const plan::Plan& plan, const std::string& path,
                                const object::Reading& asked) {
  object::Reading reading = asked;
  reading.shells = plan.shells;
  if (!plan.repair || Sha256(ReadFile(path)) == plan.repair->sha256) {
    return object::ReadObject(path, reading);
  }
  return ReadRepaired(path, plan.repair->options, reading);
}

void CheckPlanFits(const plan::Plan& plan, const object::ObjectFile& object,
                   const PlanAndObject& given) {
  if (plan.dimension != object.object->dimension()) {
    throw InputError(given.plan_path + ": /object/dimension: expected " +
                     std::to_string(object.object->dimension()) + " as of " + given.object_path +
                     ", found " + std::to_string(plan.dimension));
  }
  if (!IsFor(plan, object) && !given.allow_object_change) {
    throw InputError(WrongObject(plan, object, given));
  }
  if (given.scale && *given.scale != plan.scale) {
    throw InputError("--scale " + FormatDouble(*given.scale) + " must be the scale of the plan, " +
                     FormatDouble(plan.scale));
  }
}

}  // namespace regrasp::apps
