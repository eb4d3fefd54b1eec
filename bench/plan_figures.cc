#include "bench/plan_figures.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace regrasp {

namespace {

double TravelOf(const plan::Switch& step, const plan::FingerGrasp& before) {
  if (step.release.empty()) return 0;
  double travel = 0;
  for (const plan::FingerContact& placed : step.place) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const FingerIndex finger : step.release) {
      const grasp::Contact& left = plan::FindFinger(before, finger)->contact;
      nearest = std::min(nearest, (left.p - placed.contact.p).norm());
    }
    travel += nearest;
  }
  return travel;
}

double TravelOf(const plan::Align& step) {
  double travel = 0;
  for (std::size_t i = 1; i < step.waypoints.size(); ++i) {
    for (const plan::FingerContact& to : step.waypoints[i]) {
      travel +=
          (plan::FindFinger(step.waypoints[i - 1], to.finger)->contact.p - to.contact.p).norm();
    }
  }
  return travel;
}

}  // namespace

int CountAligns(const plan::Plan& plan) {
  return static_cast<int>(std::ranges::count_if(plan.steps, [](const plan::Step& step) {
    return std::holds_alternative<plan::Align>(step);
  }));
}

double TravelOf(const plan::Plan& plan) {
  double travel = 0;
  plan::FingerGrasp holding = plan.initial;
  for (const plan::Step& step : plan.steps) {
    const auto* change = std::get_if<plan::Switch>(&step);
    const auto* align = std::get_if<plan::Align>(&step);
    if (change != nullptr) travel += TravelOf(*change, holding);
    if (align != nullptr) travel += TravelOf(*align);
    holding = plan::GraspAfter(holding, step);
  }
  return travel;
}

}  // namespace regrasp
