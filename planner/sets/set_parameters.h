#pragma once

#include <string>
#include <vector>

#include "planner/planning/plan_request.h"

namespace regrasp::sets {

/// Option of the planners `polygon` and `polyhedron`, as users write it.
inline constexpr char kUniformSpanningOption[] = "--planner spanning=uniform";

/// Parameters of the planners `polygon` and `polyhedron` in PlanRequest::parameters.
struct SetParameters {
  planning::Spanning spanning = planning::Spanning::kAdaptive;

  [[nodiscard]] std::vector<std::string> Options() const {
    if (spanning == planning::Spanning::kAdaptive) return {};
    return {kUniformSpanningOption};
  }
};

/// Return the spanning of a request.
[[nodiscard]] inline planning::Spanning SpanningOf(const planning::PlanRequest& request) {
  return request.parameters.Get<SetParameters>().spanning;
}

}  // namespace regrasp::sets
