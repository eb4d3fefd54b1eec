// Rotate an object in a hand and replay the plan on the hand's actuators: rotate_in_hand HAND
// OBJECT SCALE DEGREES
#include <cstdlib>
#include <iostream>
#include <memory>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/gait/gait_planner.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/object.h"
#include "planner/object/polyhedron.h"
#include "planner/planning/in_hand_task.h"
#include "planner/planning/solve.h"
#include "planner/registry/registry.h"
#include "report/report.h"
#include "sim/actuation/simulate_execution.h"
#include "sim/validation/validation.h"

using namespace regrasp;

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "usage: rotate_in_hand HAND OBJECT SCALE DEGREES\n";
    return 2;
  }
  try {
    const kinematics::HandFile hand = kinematics::ReadHandFile(argv[1]);
    const object::ObjectFile file = object::ReadObject(argv[2]);
    const auto* solid = dynamic_cast<const object::Polyhedron*>(file.object.get());
    if (solid == nullptr) throw InputError(file.file + ": a hand requires a solid");

    planning::InHandTask task{.hand = &hand.hand, .scale = std::atof(argv[3])};
    task.turn = {Eigen::Vector3d::UnitZ(), Radians(std::atof(argv[4]))};
    task.simulate = sim::ExecutionSimulator(hand, *solid);  // simulates candidates

    planning::PlanRequest request;
    request.object = solid;
    request.object_name = file.file;
    request.criteria.friction_angle = std::atan(0.8);
    request.seed = 1;
    gait::AskInHand(task, request);

    const planning::PlanResult result = planning::Solve(registry::ChoosePlanner(request), request);
    if (!result.plan) {
      std::cout << "no plan found: " << result.message << '\n';
      return 1;
    }
    plan::Plan plan = *result.plan;
    plan.object_file = file.file;
    plan.object_sha256 = file.sha256;
    plan.scale = task.scale;

    // The hand's actuators execute the plan, for an object with the density of water.
    const report::Report report =
        validation::Validate({.object = *solid, .plan = plan, .hand = &hand}).report;
    std::cout << report::FormatReportTable(report);
    return report.passed() ? 0 : 1;
  } catch (const InputError& error) {
    std::cerr << "rotate_in_hand: error: " << error.what() << '\n';
    return 2;
  }
}
