// Uses one thing of each library: reads an object, tests a grasp, builds a scene, draws nothing.
#include <cstdio>

#include "apps/batch/batch_summary.h"
#include "planner/base/angle.h"
#include "planner/grasp/force_closure.h"
#include "planner/object/object.h"
#include "planner/plan/check.h"
#include "render/frames/frame.h"
#include "report/page/quantity.h"
#include "sim/replay/replay.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const regrasp::ObjectFile file = regrasp::ReadObject(argv[1]);
  const double half = 0.03;  // of the cube's edge
  const regrasp::Grasp grasp = {{{-half, 0, 0}, {1, 0, 0}},
                                {{half, 0, 0}, {-1, 0, 0}},
                                {{0, -half, 0}, {0, 1, 0}},
                                {{0, half, 0.0}, {0, -1, 0}}};
  const bool closed =
      regrasp::IsForceClosure(grasp, file.object->wrench_frame(), regrasp::Radians(30));
  regrasp::Plan plan;
  plan.half_angle = regrasp::Radians(30);
  plan.fingers = 5;
  for (int i = 0; i < 4; ++i) plan.initial.push_back({i, grasp[i]});
  plan = regrasp::LocatePlan(*file.object, plan);
  const bool scene = !regrasp::SceneMjcf(*file.object, plan, {}).empty();
  const bool image = regrasp::Image{}.rgb.empty();
  const bool summary = !regrasp::FormatSummaryJson({}).empty();
  std::printf("force closure %d, scene %d, image %d, summary %d\n", closed, scene, image, summary);
  return closed && scene && image && summary ? 0 : 1;
}
