#include "planner/roadmap/surface_draw.h"

#include "planner/base/number.h"
#include "planner/graph/grasp_choice.h"
#include "planner/graph/plan_search.h"
#include "planner/plan/clearance.h"
#include "planner/plan/reach.h"
#include "planner/roadmap/surface_sample.h"

namespace regrasp {

namespace {

/// Contacts drawn before room is no longer asked for: on nearly all of a surface fingers have it.
constexpr int kMostDraws = 1000;

}  // namespace

Grasp DrawOnSurface(const Polyhedron& solid, int contacts, const GraspJudge& judge,
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
              HasStandingRoom(solid, contact) && CanReach(solid, contact, judge.finger_radius());
          if (!serves && draw > kMostDraws && judge.finger_radius() > 0) {
            throw NoGrasp{name + ": a finger of radius " + FormatShort(judge.finger_radius()) +
                          " reaches none of " + std::to_string(kMostDraws) +
                          " points drawn on the surface"};
          }
          if (serves || draw > kMostDraws) drawn.push_back(contact);
        }
        return drawn;
      },
      judge.frame(), judge.half_angle(), judge.min_quality(), kSamePoint * solid.diameter(),
      judge.finger_radius());
  if (grasp) return *grasp;
  throw NoGrasp{name + ": none of " + std::to_string(kMaxSurfaceDraws) +
                " grasps drawn on the surface is force closure with a quality of at least " +
                FormatShort(judge.min_quality()) +
                (judge.finger_radius() > 0
                     ? ", its fingers of radius " + FormatShort(judge.finger_radius()) + " apart"
                     : "")};
}

}  // namespace regrasp
