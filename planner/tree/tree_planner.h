#pragma once

#include <cstdint>

#include "planner/planning/candidate_sequence.h"
#include "planner/planning/planner.h"
#include "planner/tree/face_align.h"

namespace regrasp::tree {

/// Return the candidate sequence of a path.
/// Fingers 0, 1, … have the contacts of `start` in its order. Consecutive sliding steps are one
/// step.
/// @param start  contacts of the path's start.
[[nodiscard]] planning::CandidateSequence MakeCandidate(const GraspPath& path,
                                                        const grasp::Grasp& start,
                                                        const SearchSpace& space);

/// Return the total travel of all fingers.
/// In a sliding step it is measured along the surface. In a finger switch it is the straight
/// distance from the released to the placed contact.
[[nodiscard]] double TravelOf(const GraspPath& path, const SearchSpace& space);

/// Planner `general`: connects any two force-closure grasps that the hand can hold, on any object.
/// It uses finger switches and sliding steps. In space, grasps have three to five contacts, with
/// soft fingers also two, and the hand has five fingers by default. In the plane, grasps have two
/// to four contacts, and the default is four fingers.
///
/// It first searches the grasps of the contacts of start and goal. Then it grows a tree from each,
/// by switches with contacts of the whole surface and by sliding steps, until they meet
/// (BidirectionalTree). Finally it shortens the sequence and improves the objective. Every sliding
/// step is proved to keep force closure.
///
/// Failure is not a proof of infeasibility; the message reports the extent of the search.
class TreePlanner final : public planning::Planner {
 public:
  TreePlanner();
  [[nodiscard]] planning::PlanResult Plan(const planning::PlanRequest& request) const override;

  /// Default search budget: number of force-closure tests, about two microseconds each.
  static constexpr std::int64_t kDefaultTests = 1'000'000;
};

}  // namespace regrasp::tree
