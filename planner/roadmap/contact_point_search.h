#pragma once

#include <deque>
#include <vector>

#include "planner/criteria/grasp_evaluator.h"
#include "planner/planning/plan_request.h"
#include "planner/planning/planner.h"

namespace regrasp::roadmap {

/// What is known of the vertices of a roadmap, of which there are millions and few are asked for: a
/// number for each vertex, a KnownGrasp for those asked for.
class KnownVertices {
 public:
  /// @param initial  what is known of every vertex before it is asked for.
  KnownVertices(int vertex_count, const criteria::KnownGrasp& initial)
      : initial_(initial), place_(vertex_count, -1) {}

  criteria::KnownGrasp& operator[](int vertex) {
    int& place = place_[vertex];
    if (place < 0) {
      place = static_cast<int>(known_.size());
      known_.push_back(initial_);
    }
    return known_[place];
  }

 private:
  criteria::KnownGrasp initial_;
  std::vector<int> place_;  ///< in `known_`; −1 where not asked for
  std::deque<criteria::KnownGrasp> known_;
};

/// Plans a sequence of finger switches on the plain roadmap of contact points and those of start
/// and goal: the fewest switches first, then the largest smallest margin to the required
/// half-angle. Grasps below the quality that is asked for are passed only where there is no other
/// path, and then a warning names the weakest step.
/// @param request  as Planner::Plan has it.
/// @throws NoGrasp, TimeUp
[[nodiscard]] planning::PlanResult SearchContactPoints(const std::vector<grasp::Contact>& contacts,
                                                       const planning::PlanRequest& request);

/// Radians: differences of margin that a plan does not care for (6e-6 degrees).
inline constexpr double kMarginTolerance = 1e-7;

}  // namespace regrasp::roadmap
