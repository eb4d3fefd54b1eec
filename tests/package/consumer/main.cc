// Uses the public headers as a program of others would: reads an object, checks a grasp, writes and
// reads a plan that holds it, and validates the plan.
#include <cstdio>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/object/object.h"
#include "planner/plan/check.h"
#include "planner/plan/plan_io.h"
#include "report/report.h"
#include "sim/validation/validation.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const regrasp::object::ObjectFile file = regrasp::object::ReadObject(argv[1]);
  const regrasp::object::Object& cube = *file.object;
  const double half = 0.03;  // of the cube's edge
  const double friction_angle = regrasp::Radians(30);
  const regrasp::grasp::Grasp grasp = {{{-half, 0, 0}, {1, 0, 0}},
                                       {{half, 0, 0}, {-1, 0, 0}},
                                       {{0, -half, 0}, {0, 1, 0}},
                                       {{0, half, 0.0}, {0, -1, 0}}};
  const bool closed = regrasp::grasp::IsForceClosure(grasp, cube.wrench_frame(), friction_angle);
  regrasp::plan::Plan hold = regrasp::validation::MakeHoldPlan(cube, grasp, friction_angle, 1);
  hold.object_file = file.file;
  hold.object_sha256 = file.sha256;
  const regrasp::plan::Plan plan =
      regrasp::plan::ParsePlan(regrasp::plan::FormatPlan(hold), "hold.json");
  const bool scene =
      !regrasp::sim::SceneMjcf(cube, regrasp::plan::ProjectPlan(cube, plan), {}).empty();
  const regrasp::report::Report report =
      regrasp::validation::Validate({.object = cube, .plan = plan}).report;
  const bool passed = report.passed();
  std::printf("force closure %d, scene %d, passed %d\n", closed, scene, passed);
  return closed && scene && passed ? 0 : 1;
}
