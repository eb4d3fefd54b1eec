#include "planner/planning/grasp_choice.h"

#include <cmath>

#include "planner/base/angle.h"
#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/required_half_angle.h"
#include "planner/plan/plan_reach.h"

namespace regrasp {

namespace {

/// Rounded up to a hundredth of a degree: with that much friction the grasp is force closure.
std::string NeededDegrees(const RequiredHalfAngle& required) {
  constexpr double kSteps = 100;
  return FormatDouble(std::ceil(Degrees(required.upper) * kSteps) / kSteps) + "°";
}

std::optional<std::pair<int, int>> ContactsAtSamePoint(const Grasp& grasp, double same_point) {
  for (std::size_t i = 0; i < grasp.size(); ++i) {
    for (std::size_t j = i + 1; j < grasp.size(); ++j) {
      if ((grasp[i].p - grasp[j].p).norm() <= same_point) return std::pair(i, j);
    }
  }
  return std::nullopt;
}

}  // namespace

void CheckGivenGrasp(const GraspChoice& choice, const ContactCount& count, const WrenchFrame& frame,
                     double half_angle, double same_point) {
  const Grasp& grasp = choice.grasp;
  const int found = static_cast<int>(grasp.size());
  if (found < count.least || found > count.most) {
    const std::string range = count.least == count.most ? "" : std::to_string(count.least) + " to ";
    throw InputError(choice.name + ": /contacts: the planner " + count.planner + " needs " + range +
                     std::to_string(count.most) + " contacts, found " + std::to_string(found));
  }
  if (const auto pair = ContactsAtSamePoint(grasp, same_point)) {
    throw InputError(choice.name + ": /contacts: contacts " + std::to_string(pair->first) +
                     " and " + std::to_string(pair->second) + " are at the same point");
  }
  if (IsForceClosure(grasp, frame, half_angle)) return;
  const auto required = ComputeRequiredHalfAngle(grasp, frame);
  throw InputError(choice.name + ": /contacts: not force closure: " +
                   (required ? "needs a friction half-angle of " + NeededDegrees(*required)
                             : std::string("no friction half-angle below 90° serves")) +
                   ", given " + FormatShort(Degrees(half_angle)) + "°");
}

void CheckFingersFit(const GraspChoice& choice, const Object& object, double finger_radius) {
  FingerGrasp held;
  for (const Contact& contact : choice.grasp) {
    held.push_back({static_cast<int>(held.size()), contact});
  }
  if (const auto obstacle = FindRestObstacle(object, held, finger_radius)) {
    throw InputError(choice.name +
                     ": /contacts: with a finger at each, by their numbers: " + *obstacle);
  }
}

}  // namespace regrasp
