#include "planner/roadmap/surface_draw.h"

#include "planner/base/number.h"
#include "planner/graph/grasp_choice.h"
#include "planner/graph/plan_search.h"
#include "planner/roadmap/surface_sample.h"

namespace regrasp {

Grasp DrawOnSurface(const Polyhedron& solid, int contacts, const GraspJudge& judge,
                    RandomStream& random, const std::string& name) {
  const SurfaceSampler sampler(solid);
  const auto grasp = DrawGoodGrasp(
      [&] {
        Grasp drawn;
        while (static_cast<int>(drawn.size()) < contacts) drawn.push_back(sampler.Draw(random));
        return drawn;
      },
      judge.frame(), judge.half_angle(), judge.min_quality(), kSamePoint * solid.diameter());
  if (grasp) return *grasp;
  throw NoGrasp{name + ": none of " + std::to_string(kMaxSurfaceDraws) +
                " grasps drawn on the surface is force closure with a quality of at least " +
                FormatShort(judge.min_quality())};
}

}  // namespace regrasp
