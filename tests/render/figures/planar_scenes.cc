#include "tests/render/figures/planar_scenes.h"

#include "planner/base/angle.h"

namespace regrasp::render {

Plan MakePlanarPlan(const FingerGrasp& initial, std::vector<Step> steps) {
  Plan plan;
  plan.dimension = 2;
  plan.half_angle = Radians(20);
  plan.fingers = 4;
  plan.initial = initial;
  plan.steps = std::move(steps);
  FingerGrasp last = initial;
  for (const Step& step : plan.steps) last = GraspAfter(last, step);
  plan.goal = ContactsOf(last);
  return plan;
}

FingerContact FingerAt(const Polygon& polygon, int finger, int edge, double u) {
  return {finger, OnEdge(polygon, edge, u)};
}

Plan MakeSquarePlan() {
  const Polygon square = MakeSquare();
  const auto at = [&](int finger, int edge, double u) { return FingerAt(square, finger, edge, u); };
  const FingerGrasp start = {at(0, 0, 0.5), at(1, 2, 0.25), at(2, 2, 0.75)};
  const FingerGrasp moved = {at(0, 0, 0.4), at(1, 2, 0.25), at(2, 2, 0.75)};
  return MakePlanarPlan(start, {Align{{start, moved}}, Switch{{at(3, 0, 0.6)}, {0}},
                                Switch{{at(0, 2, 0.4)}, {1, 2}}});
}

Plan MakeTrianglePlan() {
  const Polygon triangle = MakeTriangle();
  const auto at = [&](int finger, int edge, double u) {
    return FingerAt(triangle, finger, edge, u);
  };
  return MakePlanarPlan({at(0, 0, 0.5), at(1, 1, 0.5), at(2, 2, 0.5)},
                        {Switch{{at(3, 0, 0.4)}, {0}}});
}

}  // namespace regrasp::render
