#pragma once

#include <vector>

#include "planner/planning/planner.h"

namespace regrasp::registry {

/// Law that every planner satisfies for every object that it supports.
struct PlannerLaw {
  const char* name;
  /// Describe how a planner breaks the law for an object; empty if it satisfies the law.
  std::string (*breach)(const planning::Planner& planner, const object::Object& object);
};

[[nodiscard]] const std::vector<PlannerLaw>& PlannerLaws();

}  // namespace regrasp::registry
