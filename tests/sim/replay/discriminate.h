#pragma once

#include <functional>
#include <random>
#include <string>

#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp::sim {

/// How many grasps the replay told apart by the friction.
struct DiscriminationCount {
  int failed_below = 0, below = 0;
  int passed_above = 0, above = 0;

  DiscriminationCount& operator+=(const DiscriminationCount& other);
};

/// Replays the hold of `grasps` random grasps: each must fail at 0.9 of its critical friction, and
/// pass at 1.5 of it where the quality allows.
/// @param draw  a grasp of the body, force closure or not; told its number.
[[nodiscard]] DiscriminationCount Discriminate(
    const object::Object& body, const std::string& name, int grasps, unsigned seed,
    const std::function<plan::FingerGrasp(int index, std::mt19937& random)>& draw);

/// Prints and records the counts, and expects at least 100 of each.
void ExpectManyDiscriminated(const DiscriminationCount& count, const std::string& grasps);

}  // namespace regrasp::sim
