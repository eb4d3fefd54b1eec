#include "sim/scene/hand_squeeze.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "planner/grasp/largest_load.h"
#include "sim/scene/scaling.h"

namespace regrasp::sim {

namespace {

/// Those that hold the object before, between and after the steps.
std::vector<grasp::Grasp> GraspsOf(const plan::Plan& plan, int entries) {
  std::vector<grasp::Grasp> grasps = {plan::ContactsOf(plan.initial)};
  plan::FingerGrasp holding = plan.initial;
  for (int i = 1; i < entries; ++i) {
    const plan::Step& step = plan.steps[i - 1];
    if (const auto* align = std::get_if<plan::Align>(&step)) {
      for (const auto& waypoint : align->waypoints) grasps.push_back(plan::ContactsOf(waypoint));
    }
    holding = plan::GraspAfter(holding, step);
    grasps.push_back(plan::ContactsOf(holding));
  }
  return grasps;
}

/// The largest weight over the squeeze that all grasps carry; those that carry none left out.
double CarriedShare(const object::Object& object, const std::vector<grasp::Grasp>& grasps,
                    double half_angle) {
  const grasp::Wrench down{-Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()};
  double least = std::numeric_limits<double>::infinity();
  for (const grasp::Grasp& grasp : grasps) {
    if (grasp.empty()) continue;
    const auto carried =
        grasp::ComputeLargestLoad(grasp, object.wrench_frame(), half_angle, {}, down, 1);
    if (carried && carried->lower > 0) least = std::min(least, carried->lower);
  }
  return std::isfinite(least) ? least : std::tan(half_angle);
}

}  // namespace

double HandSqueeze(const object::Object& object, const plan::Plan& located, int entries,
                   double half_angle, double mass_kg) {
  const double share = object.dimension() == 2
                           ? std::tan(half_angle)
                           : CarriedShare(object, GraspsOf(located, entries), half_angle);
  return std::min(kGripSafety * mass_kg * kGravity / share, kStrongestGrip_N);
}

}  // namespace regrasp::sim
