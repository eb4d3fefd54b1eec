#pragma once

#include <functional>
#include <random>
#include <string>

#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp::sim {

/// Number of grasps whose replays the friction decides correctly.
struct DiscriminationCount {
  int failed_below = 0, below = 0;
  int passed_above = 0, above = 0;

  DiscriminationCount& operator+=(const DiscriminationCount& other);
};

/// Replay `grasps` random grasps. Each must fail at 0.9 of its required friction, and pass at 1.5
/// of it if the quality is sufficient.
/// @param draw  function that returns a grasp of the object, force closure or not; its argument is
///     the number of the grasp.
[[nodiscard]] DiscriminationCount Discriminate(
    const object::Object& body, const std::string& name, int grasps, unsigned seed,
    const std::function<plan::FingerGrasp(int index, std::mt19937& random)>& draw);

/// Print and record the counts, and expect at least 100 of each.
void ExpectManyDiscriminated(const DiscriminationCount& count, const std::string& grasps);

}  // namespace regrasp::sim
