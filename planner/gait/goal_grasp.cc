#include "planner/gait/goal_grasp.h"

#include <algorithm>
#include <limits>

namespace regrasp::gait {
namespace {

/// What it costs not to be there, and metres along the surface that cost as much as a finger that
/// does not hold at all.
constexpr double kNear = 0.3;
constexpr double kFar = 0.08;

}  // namespace

bool GoalGrasp::IsHeldBy(const Holding& holding) const {
  if (points_.empty()) return true;
  return std::ranges::count(holding, kNone) + std::ssize(points_) == std::ssize(holding) &&
         std::ranges::all_of(points_, [&](int point) {
           return std::ranges::find(holding, point) != holding.end();
         });
}

/// Of a finger that holds at one contact and should at another one.
double GoalGrasp::DistanceBetween(int from, int to) const {
  if (from == to) return 0;
  if (from == kNone || to == kNone) return 1;
  const double apart = (surface_[from].p - surface_[to].p).norm();
  const double turned = 1 - surface_[from].n.dot(surface_[to].n);
  return std::min(1.0, kNear + apart / kFar + turned / 2);
}

double GoalGrasp::DistanceBetween(const Holding& from, const Holding& to) const {
  double distance = 0;
  for (std::size_t i = 0; i < from.size(); ++i) distance += DistanceBetween(from[i], to[i]);
  return distance;
}

const Holding* GoalGrasp::NearestTo(const Holding& holding) const {
  const Holding* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const auto* holdings : {&ways_, &targets_}) {
    for (const Holding& other : *holdings) {
      const double distance = DistanceBetween(holding, other);
      if (distance >= least) continue;
      least = distance;
      nearest = &other;
    }
  }
  return nearest;
}

std::vector<Holding> GoalGrasp::NearestOfSameFingers(const Holding& holding, int most) const {
  std::vector<std::pair<double, const Holding*>> found;
  for (const auto* holdings : {&ways_, &targets_}) {
    for (const Holding& other : *holdings) {
      const bool is_same = std::ranges::equal(
          holding, other, {}, [](int point) { return point == kNone; },
          [](int point) { return point == kNone; });
      if (is_same && other != holding) found.emplace_back(DistanceBetween(holding, other), &other);
    }
  }
  std::ranges::stable_sort(found, {}, &std::pair<double, const Holding*>::first);
  std::vector<Holding> nearest;
  for (const auto& [distance, other] : found) {
    if (std::ssize(nearest) == most) break;
    nearest.push_back(*other);
  }
  return nearest;
}

double GoalGrasp::DistanceFrom(const Holding& holding) const {
  const Holding* nearest = NearestTo(holding);
  return nearest == nullptr ? 0 : DistanceBetween(holding, *nearest);
}

std::set<int> GoalGrasp::ContactsOf(FingerIndex finger) const {
  std::set<int> contacts;
  for (const Holding& way : ways_) {
    if (way[finger] != kNone) contacts.insert(way[finger]);
  }
  return contacts;
}

}  // namespace regrasp::gait
