#pragma once

#include <deque>
#include <vector>

#include "planner/criteria/grasp_evaluator.h"
#include "planner/planning/plan_request.h"
#include "planner/planning/planner.h"

namespace regrasp::roadmap {

/// Plan a sequence on a roadmap of clusters.
/// FindContactChain finds a sequence. Its contacts are the contact points of a roadmap without
/// clusters, which then shortens the sequence and increases its margin. Random grasps are drawn
/// from all force-closure grasps of four contact points. A random goal is drawn again until there
/// is a sequence to it.
/// @param request  as Planner::Plan.
/// @throws NoGrasp, TimeUp  as SearchContactPoints.
[[nodiscard]] planning::PlanResult SearchClusters(const planning::PlanRequest& request);

/// Cached evaluations of the vertices of a roadmap.
/// There are millions of vertices, of which few are evaluated. Therefore each vertex has only an
/// index, and each evaluated one a KnownGrasp.
class KnownVertices {
 public:
  /// @param initial  initial evaluation of every vertex.
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
  std::vector<int> place_;  ///< index in `known_`; −1 if not evaluated
  std::deque<criteria::KnownGrasp> known_;
};

/// Plan a sequence of finger switches on the roadmap of contact points and those of start and goal.
/// Minimizes the number of switches, then maximizes the smallest friction margin. Grasps below the
/// required quality are used only if there is no other path; then a warning names the weakest step.
/// @param request  as Planner::Plan.
/// @throws NoGrasp  if no random grasp of sufficient quality is found.
/// @throws TimeUp  if the deadline passes.
[[nodiscard]] planning::PlanResult SearchContactPoints(const std::vector<grasp::Contact>& contacts,
                                                       const planning::PlanRequest& request);

/// Difference of margins, radians, that is irrelevant for a plan (6e-6 degrees).
inline constexpr double kMarginTolerance = 1e-7;

}  // namespace regrasp::roadmap
