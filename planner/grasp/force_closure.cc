#include "planner/grasp/force_closure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "planner/base/in_blocks.h"
#include "planner/grasp/force_closure_core.h"
#include "planner/grasp/quality.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/grasp/unit_contacts.h"

namespace regrasp::grasp {
namespace {

/// Result with an unknown margin.
constexpr ForceClosure kUnknown{Decision::kTooClose, -1.0, std::numeric_limits<double>::infinity()};

/// Distance between contacts, over the radius of the grasp, below which too few digits remain to
/// distinguish directions between them.
constexpr double kResolved = 1e-7;

/// Return whether two distinct contacts are too close to each other for the grasp's radius.
bool IsUnresolved(std::span<const Contact> contacts, double radius) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (std::size_t j = i + 1; j < contacts.size(); ++j) {
      const Eigen::Vector3d apart = contacts[i].p - contacts[j].p;
      const double distance = apart.lpNorm<Eigen::Infinity>();
      if (distance > 0 && !(distance >= kResolved * radius)) return true;
    }
  }
  return false;
}

bool Coincide(std::span<const Contact> contacts) {
  return std::ranges::all_of(contacts, [&](const Contact& c) { return c.p == contacts.front().p; });
}

}  // namespace

ForceClosure TestForceClosure(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                              double friction_angle) {
  CheckGrasp(contacts, frame);
  CheckFrictionAngle(friction_angle);
  const object::WrenchFrame own = ContactFrame(contacts, frame.dimension);
  if (!(own.radius > 0)) {
    // Soft fingers at one point may resist every torque, but there is no frame to decide it in. The
    // squares of the distances of very close points may also be 0.
    const bool soft = std::ranges::any_of(contacts, [](const Contact& c) { return c.torsion > 0; });
    if (soft || !Coincide(contacts)) return kUnknown;
    return {Decision::kNo, -1.0, -std::numeric_limits<double>::min()};
  }
  if (!std::isfinite(own.radius)) return kUnknown;
  UnitContacts units = MakeUnitContacts(contacts, own);
  SetUnitForces(units, friction_angle);
  const ForceClosure answer =
      frame.dimension == 3 ? DecideForceClosure<6>(units) : DecideForceClosure<3>(units);
  const bool unsure = answer.decision == Decision::kNo && IsUnresolved(contacts, own.radius);
  return unsure ? kUnknown : answer;
}

bool IsForceClosure(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                    double friction_angle) {
  return TestForceClosure(contacts, frame, friction_angle).decision == Decision::kYes;
}

namespace {

/// Number of grasps per block of work: large enough that the cost of taking a block is negligible,
/// small enough that the threads end together.
constexpr std::size_t kBlock = 256;

/// Number of grasps per block if each grasp takes 0.1 ms or more.
constexpr std::size_t kBlockOfSlow = 4;

std::size_t CountGrasps(const GraspArrays& grasps) {
  if (grasps.contacts < 1) {
    throw std::invalid_argument("contacts per grasp must be at least 1, found " +
                                std::to_string(grasps.contacts));
  }
  const std::size_t values = 3 * static_cast<std::size_t>(grasps.contacts);
  if (grasps.points.size() != grasps.normals.size() || grasps.points.size() % values != 0) {
    throw std::invalid_argument("points and normals must have equal sizes, a multiple of " +
                                std::to_string(values) + ", found " +
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
