#include "bench/plan_figures.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace regrasp {

namespace {

const FingerContact& ContactOf(int finger, const FingerGrasp& grasp) {
  const auto found = std::ranges::find(grasp, finger, &FingerContact::finger);
  assert(found != grasp.end());
  return *found;
}

double TravelOf(const Switch& step, const FingerGrasp& before) {
  if (step.release.empty()) return 0;
  double way = 0;
  for (const FingerContact& placed : step.place) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const int finger : step.release) {
      const Contact& left = ContactOf(finger, before).contact;
      nearest = std::min(nearest, (left.p - placed.contact.p).norm());
    }
    way += nearest;
  }
  return way;
}

double TravelOf(const Align& step) {
  double way = 0;
  for (std::size_t i = 1; i < step.waypoints.size(); ++i) {
    for (const FingerContact& to : step.waypoints[i]) {
      way += (ContactOf(to.finger, step.waypoints[i - 1]).contact.p - to.contact.p).norm();
    }
  }
  return way;
}

}  // namespace

int CountAligns(const Plan& plan) {
  return static_cast<int>(std::ranges::count_if(
      plan.steps, [](const Step& step) { return std::holds_alternative<Align>(step); }));
}

double TravelOf(const Plan& plan) {
  double way = 0;
  FingerGrasp holding = plan.initial;
  for (const Step& step : plan.steps) {
    const auto* change = std::get_if<Switch>(&step);
    way += change != nullptr ? TravelOf(*change, holding) : TravelOf(std::get<Align>(step));
    holding = GraspAfter(holding, step);
  }
  return way;
}

}  // namespace regrasp
