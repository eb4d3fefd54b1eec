#include "bench/random_grasps.h"

#include <cmath>
#include <optional>

#include "planner/base/number.h"
#include "planner/base/random.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "planner/grasp/required_friction_angle.h"

namespace regrasp {
namespace {

/// Maximum required friction angle: grasps that need more friction are not planned in practice.
constexpr double kMostRequired = Radians(50);
constexpr double kLeastRequired = Radians(0.5);
/// Minimum quality of the grasp before a switch.
constexpr double kFirstQuality = 0.03;

grasp::Grasp DrawGrasp(const GraspedBody& body, RandomStream& random) {
  grasp::Grasp grasp;
  for (int i = 0; i < body.hold(); ++i) grasp.push_back(body.source().Draw(random));
  return grasp;
}

/// Return the required friction angle of a grasp; nullopt if the grasp is not worth a replay.
std::optional<grasp::RequiredFrictionAngle> Required(const GraspedBody& body,
                                                     const grasp::Grasp& grasp) {
  if (!grasp::IsForceClosure(grasp, body.object().wrench_frame(), kMostRequired))
    return std::nullopt;
  const auto required = grasp::ComputeRequiredFrictionAngle(grasp, body.object().wrench_frame());
  if (!required || required->upper > kMostRequired || required->upper < kLeastRequired) {
    return std::nullopt;
  }
  return required;
}

/// Return a plan that holds the grasp.
plan::Plan PlanOf(const GraspedBody& body, const grasp::Grasp& initial, double friction_angle) {
  plan::Plan plan;
  plan.dimension = body.object().dimension();
  plan.friction_angle = friction_angle;
  plan.fingers = body.hold() + 1;
  plan.initial = plan::FingersInOrder(initial);
  plan.goal = initial;
  return plan;
}

double DrawRatio(RandomStream& random) {
  return kLeastRatio + (kMostRatio - kLeastRatio) * random.Uniform();
}

}  // namespace

std::vector<RandomCase> DrawHolds(const GraspedBody& body, int count, std::uint64_t seed) {
  RandomStream random(seed, RandomUse::kStart);
  std::vector<RandomCase> cases;
  while (static_cast<int>(cases.size()) < count) {
    const grasp::Grasp grasp = DrawGrasp(body, random);
    const auto required = Required(body, grasp);
    if (!required) continue;
    const double ratio = DrawRatio(random);
    cases.push_back({PlanOf(body, grasp, std::atan(ratio * std::tan(required->upper))), grasp,
                     ratio, *required});
  }
  return cases;
}

std::vector<RandomCase> DrawSwitches(const GraspedBody& body, int count, std::uint64_t seed) {
  RandomStream random(seed, RandomUse::kGoal);
  std::vector<RandomCase> cases;
  while (static_cast<int>(cases.size()) < count) {
    const grasp::Grasp first = DrawGrasp(body, random);
    grasp::Grasp second = first;
    second.erase(second.begin());
    second.push_back(body.source().Draw(random));
    const auto required = Required(body, second);
    if (!required) continue;
    const double ratio = DrawRatio(random);
    const double friction_angle = std::atan(ratio * std::tan(required->upper));
    if (!grasp::QualityAtLeast(first, body.object().wrench_frame(), friction_angle, kFirstQuality))
      continue;
    RandomCase drawn{PlanOf(body, first, friction_angle), second, ratio, *required};
    drawn.plan.steps.push_back(
        plan::Switch{{{FingerIndex(body.hold()), second.back()}}, {FingerIndex(0)}});
    drawn.plan.goal = second;
    cases.push_back(std::move(drawn));
  }
  return cases;
}

}  // namespace regrasp
