// Plan a regrasp between two random grasps and validate it: plan_and_validate OBJECT [SEED]
#include <cstdlib>
#include <iostream>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/object/object.h"
#include "planner/plan/plan_io.h"
#include "planner/planning/solve.h"
#include "planner/registry/registry.h"
#include "report/report.h"
#include "sim/validation/validation.h"

using namespace regrasp;

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: plan_and_validate OBJECT [SEED]\n";
    return 2;
  }
  try {
    const object::ObjectFile file = object::ReadObject(argv[1]);

    planning::PlanRequest request;
    request.object = file.object.get();
    request.object_name = file.file;
    request.criteria.friction_angle = Radians(20);  // friction angle
    request.start.kind = planning::GraspChoice::Kind::kRandom;
    request.goal.kind = planning::GraspChoice::Kind::kRandom;
    request.seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;

    const planning::Planner& planner = registry::ChoosePlanner(request);
    const planning::PlanResult result = planning::Solve(planner, request);
    if (!result.plan) {
      std::cout << "no plan found: " << result.message << '\n';
      return 1;
    }
    // The caller must set files and their digests.
    plan::Plan plan = *result.plan;
    plan.object_file = file.file;
    plan.object_sha256 = file.sha256;
    std::cout << planner.name() << ": " << plan.steps.size() << " steps\n";

    const report::Report report =
        validation::Validate({.object = *file.object, .plan = plan}).report;
    std::cout << report::FormatReportTable(report);
    return report.passed() ? 0 : 1;
  } catch (const InputError& error) {
    std::cerr << "plan_and_validate: error: " << error.what() << '\n';
    return 2;
  }
}
