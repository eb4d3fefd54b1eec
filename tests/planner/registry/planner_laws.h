#pragma once

#include <vector>

#include "planner/planning/planner.h"

namespace regrasp::registry {

/// What every planner keeps to on every object that it works on.
struct PlannerLaw {
  const char* name;
  /// What of it a planner does not keep to on an object, for people; empty where all is well.
  std::string (*breach)(const planning::Planner& planner, const object::Object& object);
};

[[nodiscard]] const std::vector<PlannerLaw>& PlannerLaws();

}  // namespace regrasp::registry
