#include "planner/registry/plan_auto.h"

#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "planner/planning/plan_search.h"
#include "planner/sets/polyhedron/plan_polyhedron.h"

namespace regrasp {

namespace {

/// Bodies with more faces have focus cells for minutes of work and gigabytes of memory.
constexpr int kMostFaces = 100;

/// Polygons with more edges have 3-finger grasps for minutes of work.
constexpr int kMostEdges = 100;

/// Polygons with more edges have 2-finger grasps for minutes of work, and gigabytes of memory: both
/// go with the square of the edges.
constexpr int kMostContourEdges = 3000;

constexpr std::size_t kConcurrentContacts = 4;
constexpr std::size_t kMostPlanarContacts = 3;

/// What an exact planner answers, or why none is asked.
struct ExactAnswer {
  PlanResult result;
  std::string why_not;  ///< empty where the result is a plan over good grasps
};

ExactAnswer MotionMonitor(PlanResult result, const std::string& planner) {
  std::string why;
  if (!result.plan) {
    why = planner + " says: " + result.message;
  } else if (!result.warnings.empty()) {
    why = planner + " only found a sequence over weaker grasps";
  }
  return {std::move(result), std::move(why)};
}

ExactAnswer AskPolyhedron(const Polyhedron& solid, const GraspChoice& start,
                          const GraspChoice& goal, const AutoPlanOptions& options) {
  const GeneralPlanOptions& common = options.general;
  if (solid.face_count() > kMostFaces) {
    return {{}, "polyhedron is for bodies of at most " + std::to_string(kMostFaces) + " faces"};
  }
  if (start.grasp.size() != kConcurrentContacts || goal.grasp.size() != kConcurrentContacts) {
    return {{}, "polyhedron is for grasps of four contacts"};
  }
  PolyhedronPlanOptions exact;
  exact.half_angle = common.half_angle;
  exact.spanning = options.spanning;
  exact.seed = common.seed;
  exact.min_quality = common.min_quality;
  exact.progress = common.progress;
  exact.finger_radius = common.finger_radius;
  exact.memory = options.memory;
  exact.deadline = common.deadline.Halfway();
  return MotionMonitor(PlanOnPolyhedron(solid, start, goal, exact), "polyhedron");
}

ExactAnswer AskPlanar(const Polygon& polygon, const GraspChoice& start, const GraspChoice& goal,
                      const AutoPlanOptions& options) {
  const GeneralPlanOptions& common = options.general;
  if (start.grasp.size() > kMostPlanarContacts || goal.grasp.size() > kMostPlanarContacts) {
    return {{}, "contour and polygon are for grasps of two or three contacts"};
  }
  const bool two = start.grasp.size() == 2 && goal.grasp.size() == 2;
  if (polygon.face_count() > kMostEdges && !two) {
    return {{}, "polygon is for polygons of at most " + std::to_string(kMostEdges) + " edges"};
  }
  if (polygon.face_count() > kMostContourEdges) {
    return {{},
            "contour is for polygons of at most " + std::to_string(kMostContourEdges) + " edges"};
  }
  PlanarPlanOptions exact;
  exact.polygon.half_angle = common.half_angle;
  exact.polygon.spanning = options.spanning;
  exact.polygon.seed = common.seed;
  exact.polygon.min_quality = common.min_quality;
  exact.polygon.progress = common.progress;
  exact.polygon.finger_radius = common.finger_radius;
  exact.polygon.memory = options.memory;
  exact.polygon.deadline = common.deadline.Halfway();
  exact.aim = options.contour_aim;
  return MotionMonitor(PlanPlanar(polygon, start, goal, exact), "polygon");
}

ExactAnswer AskExact(const Object& object, const GraspChoice& start, const GraspChoice& goal,
                     const AutoPlanOptions& options) {
  if (options.general.aim != Objective::kSteps) return {{}, "it makes sequences best in this"};
  if (const auto* solid = dynamic_cast<const Polyhedron*>(&object)) {
    return AskPolyhedron(*solid, start, goal, options);
  }
  return AskPlanar(dynamic_cast<const Polygon&>(object), start, goal, options);
}

}  // namespace

PlanResult PlanAuto(const Object& object, const GraspChoice& start, const GraspChoice& goal,
                    const AutoPlanOptions& options) {
  GraspChoice from, to;
  try {
    from = ResolveGrasp(object, start, RandomUse::kStart, options.general);
    to = ResolveGrasp(object, goal, RandomUse::kGoal, options.general);
  } catch (const NoGrasp& none) {
    return ResultOf(none);
  }
  ExactAnswer exact = AskExact(object, from, to, options);
  if (exact.why_not.empty()) return std::move(exact.result);
  options.general.progress("general, since " + exact.why_not);
  PlanResult result = PlanGeneral(object, from, to, options.general);
  if (!result.plan) {
    if (exact.result.plan) return std::move(exact.result);
    result.message += "; " + exact.why_not;
  }
  result.notes.insert(result.notes.begin(), "general, since " + exact.why_not);
  return result;
}

}  // namespace regrasp
