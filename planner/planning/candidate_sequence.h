#pragma once

#include <optional>
#include <vector>

#include "planner/plan/plan.h"
#include "planner/search/vertex_pair.h"

namespace regrasp::planning {

/// A grasp that a sequence rests in.
struct Rest {
  grasp::Grasp grasp;
  /// The switch of the graph that it was chosen for; none for what start and goal give.
  std::optional<search::VertexPair> chosen_for;
};

/// A sequence and what is known of it.
struct CandidateSequence {
  plan::FingerGrasp initial;
  std::vector<plan::Step> steps;
  std::vector<Rest> rests;  ///< before all steps and after each
};

/// No steps: the fingers take the contacts of a grasp in their order.
[[nodiscard]] CandidateSequence StartOf(const grasp::Grasp& grasp);

}  // namespace regrasp::planning
