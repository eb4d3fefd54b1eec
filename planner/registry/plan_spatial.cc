#include "planner/registry/plan_spatial.h"

#include "planner/planning/plan_search.h"
#include "planner/sampling/draw_grasp.h"

namespace regrasp {

namespace {

constexpr int kContacts = 4;

/// Bodies with more faces have focus cells for minutes of work and gigabytes of memory.
constexpr int kMostFaces = 100;

GraspChoice Draw(const Polyhedron& solid, GraspChoice choice, RandomUse use,
                 const RoadmapOptions& options) {
  if (choice.kind == GraspChoice::Kind::kGiven) return choice;
  const GraspEvaluator evaluator(solid, {options.half_angle, options.min_quality},
                                 {.fingertip_radius = options.finger_radius});
  RandomStream random(options.seed, use);
  choice.grasp = DrawOnSurface(solid, {kContacts, kContacts}, evaluator, random, choice.name,
                               [&] { options.deadline.Check(); });
  choice.kind = GraspChoice::Kind::kGiven;
  return choice;
}

}  // namespace

PlanResult PlanSpatial(const Polyhedron& solid, const GraspChoice& start, const GraspChoice& goal,
                       Spanning spanning, const RoadmapOptions& options) {
  GraspChoice from, to;
  try {
    from = Draw(solid, start, RandomUse::kStart, options);
    to = Draw(solid, goal, RandomUse::kGoal, options);
  } catch (const NoGrasp& none) {
    return ResultOf(none);
  } catch (const TimeUp& time_up) {
    return ResultOf(time_up, "roadmap");
  }
  if (solid.face_count() <= kMostFaces) {
    const PlanResult result = PlanOnPolyhedron(
        solid, from, to,
        {options.half_angle, spanning, options.seed, options.min_quality, options.progress,
         options.finger_radius, options.memory, options.deadline.Halfway()});
    if (result.plan && result.warnings.empty()) return result;
    if (!result.plan) options.progress("roadmap, since polyhedron says: " + result.message);
  }
  return PlanOnRoadmap(solid, from, to, options);
}

}  // namespace regrasp
