#pragma once

#include <cstdint>

#include "planner/planning/candidate_sequence.h"
#include "planner/planning/planner.h"
#include "planner/tree/grasp_path.h"
#include "planner/tree/search_space.h"

namespace regrasp::tree {

/// What the hand does along a path: fingers 0, 1, … take the contacts of `start` in its order;
/// aligns that follow each other are one step.
/// @param start  the contacts of the path's start.
[[nodiscard]] planning::CandidateSequence MakeCandidate(const GraspPath& path,
                                                        const grasp::Grasp& start,
                                                        const SearchSpace& space);

/// The travel of all fingers together: along the surface in an align, straight from where one
/// leaves to where one comes in a switch.
[[nodiscard]] double TravelOf(const GraspPath& path, const SearchSpace& space);

/// The planner `general`: joins any two force-closure grasps that the hand can hold, on any body,
/// in space (three to five contacts, of soft fingers from two on, a hand of five fingers) and in
/// the plane (two to four contacts, four fingers), with switches and aligns.
///
/// First the grasps of the two grasps' own contacts; then a tree from each, grown by switches with
/// contacts of the whole surface and by aligns, until they meet (BidirectionalTree). The sequence
/// is then shortened, and made better in what the objective asks for. Every align is proved to keep
/// force closure.
///
/// Failure is not a proof of infeasibility: the message says what was reached.
class TreePlanner final : public planning::Planner {
 public:
  TreePlanner();
  [[nodiscard]] planning::PlanResult Plan(const planning::PlanRequest& request) const override;

  /// Default search budget: number of force-closure tests, about two microseconds each.
  static constexpr std::int64_t kDefaultTests = 1'000'000;
};

}  // namespace regrasp::tree
