#include "planner/grasp/judge_grasps.h"

#include <limits>
#include <stdexcept>
#include <string>

#include "planner/base/in_blocks.h"
#include "planner/grasp/bound_quality.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/grasp/unit_contacts.h"

namespace regrasp::grasp {
namespace {

/// Number of grasps per block of work: large enough that the cost of taking a block is negligible,
/// small enough that the threads end together.
constexpr std::size_t kBlock = 256;

/// Number of grasps per block if each grasp takes 0.1 ms or more.
constexpr std::size_t kBlockOfSlow = 4;

std::size_t CountGrasps(const GraspArrays& grasps) {
  if (grasps.contacts < 1) {
    throw std::invalid_argument("a grasp needs a contact, not " + std::to_string(grasps.contacts));
  }
  const std::size_t values = 3 * static_cast<std::size_t>(grasps.contacts);
  if (grasps.points.size() != grasps.normals.size() || grasps.points.size() % values != 0) {
    throw std::invalid_argument("points and normals need as many values, a multiple of " +
                                std::to_string(values) + ", not " +
                                std::to_string(grasps.points.size()) + " and " +
                                std::to_string(grasps.normals.size()));
  }
  return grasps.points.size() / values;
}

void Load(const GraspArrays& grasps, std::size_t index, double torsion, Grasp& grasp) {
  for (std::size_t c = 0; c < grasp.size(); ++c) {
    const std::size_t start = 3 * (index * grasp.size() + c);
    grasp[c].p = Eigen::Map<const Eigen::Vector3d>(&grasps.points[start]);
    grasp[c].n = Eigen::Map<const Eigen::Vector3d>(&grasps.normals[start]);
    grasp[c].torsion = torsion;
  }
}

void Judge(const Grasp& grasp, const JudgeOptions& options, std::size_t index,
           GraspVerdicts& verdicts) {
  verdicts.force_closure[index] = TestForceClosure(grasp, options.frame, options.friction_angle);
  if (options.required_friction_angle) {
    const auto required = ComputeRequiredFrictionAngle(grasp, options.frame);
    verdicts.required_friction_angle[index] =
        required ? required->upper : std::numeric_limits<double>::quiet_NaN();
  }
  if (options.quality) {
    const QualityBounds quality = BoundQuality(grasp, options.frame, options.friction_angle);
    verdicts.quality[index] = quality.lower;
    verdicts.quality_upper[index] = quality.upper;
  }
}

}  // namespace

GraspVerdicts JudgeGrasps(const GraspArrays& grasps, const JudgeOptions& options) {
  const std::size_t count = CountGrasps(grasps);
  CheckFrictionAngle(options.friction_angle);
  GraspVerdicts verdicts;
  verdicts.force_closure.resize(count);
  if (options.required_friction_angle) verdicts.required_friction_angle.resize(count);
  if (options.quality) {
    verdicts.quality.resize(count);
    verdicts.quality_upper.resize(count);
  }

  const bool slow = options.required_friction_angle || options.quality;
  InBlocks(
      count, slow ? kBlockOfSlow : kBlock, options.threads,
      [&](std::size_t begin, std::size_t end) {
        Grasp grasp(static_cast<std::size_t>(grasps.contacts));
        for (std::size_t index = begin; index < end; ++index) {
          Load(grasps, index, options.torsion, grasp);
          try {
            Judge(grasp, options, index, verdicts);
          } catch (const std::invalid_argument& error) {
            throw std::invalid_argument("grasp " + std::to_string(index) + ": " + error.what());
          }
        }
      });
  return verdicts;
}

}  // namespace regrasp::grasp
