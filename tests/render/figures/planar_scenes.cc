#include "tests/render/figures/planar_scenes.h"

#include "planner/base/number.h"

namespace regrasp::render {

plan::Plan MakePlanarPlan(const plan::FingerGrasp& initial, std::vector<plan::Step> steps) {
  plan::Plan plan;
  plan.dimension = 2;
  plan.friction_angle = Radians(20);
  plan.fingers = 4;
  plan.initial = initial;
  plan.steps = std::move(steps);
  plan::FingerGrasp last = initial;
  for (const plan::Step& step : plan.steps) last = plan::GraspAfter(last, step);
  plan.goal = plan::ContactsOf(last);
  return plan;
}

plan::FingerContact FingerAt(const object::Polygon& polygon, int finger, int edge, double u) {
  return {FingerIndex(finger), OnEdge(polygon, edge, u)};
}

plan::Plan MakeSquarePlan() {
  const object::Polygon square = MakeSquare();
  const auto at = [&](int finger, int edge, double u) { return FingerAt(square, finger, edge, u); };
  const plan::FingerGrasp start = {at(0, 0, 0.5), at(1, 2, 0.25), at(2, 2, 0.75)};
  const plan::FingerGrasp moved = {at(0, 0, 0.4), at(1, 2, 0.25), at(2, 2, 0.75)};
  return MakePlanarPlan(
      start, {plan::Align{{start, moved}}, plan::Switch{{at(3, 0, 0.6)}, {FingerIndex(0)}},
              plan::Switch{{at(0, 2, 0.4)}, {FingerIndex(1), FingerIndex(2)}}});
}

plan::Plan MakeTrianglePlan() {
  const object::Polygon triangle = MakeTriangle();
  const auto at = [&](int finger, int edge, double u) {
    return FingerAt(triangle, finger, edge, u);
  };
  return MakePlanarPlan({at(0, 0, 0.5), at(1, 1, 0.5), at(2, 2, 0.5)},
                        {plan::Switch{{at(3, 0, 0.4)}, {FingerIndex(0)}}});
}

}  // namespace regrasp::render
