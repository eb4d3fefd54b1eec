#include "bench/least_friction.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace regrasp::bench {
namespace {

/// Tested sums of the normal forces: from the largest down to kLeastNormal times the load, each
/// smaller than the one before by the factor kLess. If a sum in between balances the load, the next
/// larger tested sum leaves less of it unbalanced than kUnbalanced.
constexpr double kLeastNormal = 0.05;
constexpr double kLess = 1.03;
constexpr double kUnbalanced = 0.03;
constexpr double kLeastFriction = 1e-4;
constexpr double kMostFriction = 10;
constexpr double kPrecision = 1e-3;

bool Balance(std::span<const grasp::Contact> contacts, const object::WrenchFrame& frame,
             double friction, const grasp::Wrench& load, double most_normal) {
  const double size = std::hypot(load.force.norm(), load.torque_over_radius.norm());
  for (double normal = most_normal; normal > kLeastNormal * size; normal /= kLess) {
    const grasp::GraspForces forces =
        grasp::ComputeGraspForces(contacts, frame, std::atan(friction), load, normal);
    if (forces.balanced || -forces.margin * normal <= kUnbalanced * size) return true;
  }
  return false;
}

}  // namespace

double LeastFriction(std::span<const grasp::Contact> contacts, const object::WrenchFrame& frame,
                     std::span<const grasp::Wrench> loads, double most_normal) {
  const auto is_enough = [&](double friction) {
    return std::ranges::all_of(loads, [&](const grasp::Wrench& load) {
      return Balance(contacts, frame, friction, load, most_normal);
    });
  };
  double low = kLeastFriction;
  double high = kMostFriction;
  if (!is_enough(high)) return std::numeric_limits<double>::infinity();
  if (is_enough(low)) return low;
  while (high - low > kPrecision * high) {
    const double middle = std::sqrt(low * high);
    (is_enough(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace regrasp::bench
