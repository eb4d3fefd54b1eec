#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/criteria/grasp_evaluator.h"
#include "planner/plan/plan.h"
#include "planner/plan/plan_reach.h"
#include "planner/planning/plan_request.h"
#include "planner/planning/planner.h"
#include "planner/search/switching_graph.h"

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

/// The finger switch from the fingers that hold to the contacts that are to hold after it: places
/// the contacts that are new with the lowest free fingers and releases those that are gone. A
/// contact is the same where its point and normal are, bit for bit.
/// @throws std::invalid_argument  the hand has too few fingers.
[[nodiscard]] plan::Switch MakeSwitch(const plan::FingerGrasp& before, const grasp::Grasp& after,
                                      int fingers);

/// Turns grasps that follow each other into finger switches of a hand of `fingers` fingers.
///
/// The first grasp's contacts get fingers 0, 1, … in their order. Each step places the contacts
/// that are new with the lowest free fingers and releases those that are gone; a contact is the
/// same where its point and normal are, bit for bit. Grasps equal to the one before give no step.
/// @throws std::invalid_argument  no grasp, or a step for which the hand has too few fingers.
[[nodiscard]] CandidateSequence MakeSwitchSequence(std::span<const grasp::Grasp> grasps,
                                                   int fingers);

/// Find the first step that fingers of the evaluator's hand cannot execute.
[[nodiscard]] std::optional<plan::PlanObstacle> FindObstacle(
    const CandidateSequence& candidate, const criteria::GraspEvaluator& evaluator);

/// Compute the smallest friction margin of the grasps of a sequence, radians.
[[nodiscard]] double SmallestMargin(const std::vector<Rest>& rests,
                                    const criteria::GraspEvaluator& evaluator);

/// Name the weakest grasps of a sequence: the first one in which a fingertip has no clearance, and
/// for each criterion that is not met everywhere the grasp that violates it most.
/// @param rests  grasps before all steps and after each step.
[[nodiscard]] std::vector<std::string> RestWarnings(const std::vector<Rest>& rests,
                                                    const criteria::GraspEvaluator& evaluator);

/// Make the result of a sequence: its plan and margin, and a warning if a grasp violates a
/// criterion.
/// @param request  its hand has as many fingers as the plan.
/// @returns a result without a plan if the fingers of the hand cannot execute the sequence.
[[nodiscard]] PlanResult ResultOf(const CandidateSequence& candidate,
                                  const criteria::GraspEvaluator& evaluator,
                                  const std::string& planner, const PlanRequest& request,
                                  const grasp::Grasp& goal);

/// Number of random goals drawn at most until a sequence passes grasps of the required quality
/// only.
inline constexpr int kGoalDraws = 12;

/// Return the first plan without a warning of kGoalDraws plans; if all have one or the deadline
/// passes, the first plan.
/// @param plan  draws a goal and plans to it; if `last`, a goal that shares a set with the start.
[[nodiscard]] PlanResult PlanToRandomGoal(const std::function<PlanResult(bool last)>& plan);

}  // namespace regrasp::planning
