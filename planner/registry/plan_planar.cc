#include "planner/registry/plan_planar.h"

#include "planner/sampling/draw_grasp.h"

namespace regrasp {

namespace {

constexpr int kLeastContacts = 2;
constexpr int kMostDrawn = 3;

/// A polygon of so many edges has sets of 3-finger grasps for seconds of work.
constexpr int kManyEdges = 100;

/// A random grasp drawn, so that both planners can be given the same; where none is found the
/// choice stays, and the planner says so.
GraspChoice Draw(const Polygon& polygon, GraspChoice choice, RandomUse use,
                 const PolygonPlanOptions& options) {
  if (choice.kind == GraspChoice::Kind::kGiven) return choice;
  const GraspEvaluator evaluator(polygon, {options.half_angle, options.min_quality},
                                 {.fingertip_radius = options.finger_radius});
  RandomStream random(options.seed, use);
  try {
    Grasp grasp = DrawOnSurface(polygon, {kLeastContacts, kMostDrawn}, evaluator, random,
                                choice.name, [&] { options.deadline.Check(); });
    return {GraspChoice::Kind::kGiven, std::move(grasp), choice.name};
  } catch (const NoGrasp&) {
    return choice;
  }
}

bool HasTwoFingers(const GraspChoice& choice) {
  return choice.kind == GraspChoice::Kind::kGiven && choice.grasp.size() == kLeastContacts;
}

}  // namespace

PlanResult PlanPlanar(const Polygon& polygon, const GraspChoice& start, const GraspChoice& goal,
                      const PlanarPlanOptions& options) {
  const PolygonPlanOptions& common = options.polygon;
  const GraspChoice from = Draw(polygon, start, RandomUse::kStart, common);
  const GraspChoice to = Draw(polygon, goal, RandomUse::kGoal, common);
  if (HasTwoFingers(from) && HasTwoFingers(to)) {
    PlanResult result =
        PlanOnContour(polygon, from, to,
                      {common.half_angle, common.seed, common.min_quality, options.aim,
                       common.progress, common.finger_radius, common.memory, common.deadline});
    if (result.plan) return result;
  }
  if (polygon.face_count() > kManyEdges) {
    common.progress("3-finger grasps of " + std::to_string(polygon.face_count()) +
                    " edges, which may take a minute");
  }
  return PlanOnPolygon(polygon, from, to, common);
}

}  // namespace regrasp
