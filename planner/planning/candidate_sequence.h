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

/// The first step that fingers of the evaluator's hand could not carry out.
[[nodiscard]] std::optional<plan::PlanObstacle> FindObstacle(
    const CandidateSequence& candidate, const criteria::GraspEvaluator& evaluator);

/// The answer that a sequence is: its plan, with its margin and a warning where a grasp does not
/// meet the criteria; none where fingers of the hand cannot carry it out.
/// @param request  its hand has as many fingers as the plan is for.
[[nodiscard]] PlanResult ResultOf(const CandidateSequence& candidate,
                                  const criteria::GraspEvaluator& evaluator,
                                  const std::string& planner, const PlanRequest& request,
                                  const grasp::Grasp& goal);

/// A random goal is drawn anew up to so many times while the sequence to it passes grasps that are
/// not as good as asked.
inline constexpr int kGoalDraws = 12;

/// The first plan without a warning of kGoalDraws, or else the first one; that one also where the
/// time is up for others.
/// @param plan  draws a goal and plans to it; the last time one that the start is in a set with.
[[nodiscard]] PlanResult PlanToRandomGoal(const std::function<PlanResult(bool last)>& plan);

}  // namespace regrasp::planning
