#include "planner/sampling/surface_draw.h"

#include "planner/base/number.h"
#include "planner/criteria/clearance.h"
#include "planner/criteria/reach.h"
#include "planner/planning/grasp_choice.h"
#include "planner/planning/plan_search.h"
#include "planner/sampling/surface_sample.h"

namespace regrasp {

namespace {

/// Contacts drawn before room is no longer asked for: on nearly all of a surface fingers have it.
constexpr int kMostDraws = 1000;

}  // namespace

Grasp DrawOnSurface(const Polyhedron& solid, int contacts, const GraspEvaluator& evaluator,
                    RandomStream& random, const std::string& name,
                    const std::function<void()>& before_draw) {
  const SurfaceSampler sampler(solid);
  const auto grasp = DrawGoodGrasp(
      [&] {
        before_draw();
        Grasp drawn;
        for (int draw = 0; static_cast<int>(drawn.size()) < contacts; ++draw) {
          const Contact contact = sampler.Draw(random);
          const bool serves =
              HasClearance(solid, contact) && CanReach(solid, contact, evaluator.finger_radius());
          if (!serves && draw > kMostDraws && evaluator.finger_radius() > 0) {
            throw NoGrasp{name + ": a finger of radius " + FormatShort(evaluator.finger_radius()) +
                          " reaches none of " + std::to_string(kMostDraws) +
                          " points drawn on the surface"};
          }
          if (serves || draw > kMostDraws) drawn.push_back(contact);
        }
        return drawn;
      },
      evaluator.frame(), evaluator.half_angle(), evaluator.min_quality(),
      kSamePoint * solid.diameter(), evaluator.finger_radius());
  if (grasp) return *grasp;
  throw NoGrasp{
      name + ": none of " + std::to_string(kMaxSurfaceDraws) +
      " grasps drawn on the surface is force closure with a quality of at least " +
      FormatShort(evaluator.min_quality()) +
      (evaluator.finger_radius() > 0
           ? ", its fingers of radius " + FormatShort(evaluator.finger_radius()) + " apart"
           : "")};
}

}  // namespace regrasp
