#include "planner/gait/goal_grasp.h"

#include <algorithm>

namespace regrasp::gait {

bool GoalGrasp::IsHeldBy(const Holding& holding) const {
  if (points_.empty()) return true;
  return std::ranges::count(holding, kNone) + std::ssize(points_) == std::ssize(holding) &&
         std::ranges::all_of(points_, [&](int point) {
           return std::ranges::find(holding, point) != holding.end();
         });
}

int GoalGrasp::DistanceFrom(const Holding& holding) const {
  int least = points_.empty() ? 0 : static_cast<int>(holding.size()) + 1;
  for (const Holding& way : ways_) {
    int distance = 0;
    for (std::size_t i = 0; i < way.size(); ++i) {
      distance += static_cast<int>(way[i] != holding[i]);
    }
    least = std::min(least, distance);
  }
  return least;
}

std::set<int> GoalGrasp::ContactsOf(FingerIndex finger) const {
  std::set<int> contacts;
  for (const Holding& way : ways_) {
    if (way[finger] != kNone) contacts.insert(way[finger]);
  }
  return contacts;
}

}  // namespace regrasp::gait
