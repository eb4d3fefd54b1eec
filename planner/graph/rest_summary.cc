#include "planner/graph/rest_summary.h"

#include <algorithm>

#include "planner/base/number.h"
#include "planner/grasp/required_half_angle.h"

namespace regrasp {

double SmallestMargin(const std::vector<Rest>& rests, const GraspJudge& judge) {
  double smallest = judge.half_angle();
  for (const Rest& rest : rests) {
    const auto required = ComputeRequiredHalfAngle(rest.grasp, judge.frame());
    smallest = std::min(smallest, required ? judge.half_angle() - required->upper : 0);
  }
  return smallest;
}

std::vector<std::string> QualityWarnings(const std::vector<Rest>& rests, const GraspJudge& judge) {
  double weakest = judge.min_quality();
  std::size_t step = 0;
  for (std::size_t i = 0; i < rests.size(); ++i) {
    if (judge.IsGood(rests[i].grasp)) continue;
    const double quality = judge.Quality(rests[i].grasp);
    if (quality >= weakest) continue;
    weakest = quality;
    step = i;
  }
  if (weakest >= judge.min_quality()) return {};
  const std::string where = step == 0 ? "the start grasp (step 0)"
                                      : "the grasp after step " + std::to_string(step) + " of " +
                                            std::to_string(rests.size() - 1);
  return {"the sequence passes grasps below the quality " + FormatShort(judge.min_quality()) +
          " that was asked for; the weakest is " + where + " with " + FormatShort(weakest)};
}

}  // namespace regrasp
