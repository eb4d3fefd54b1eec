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

/// A static grasp of a sequence: a grasp before or after a step.
struct StaticGrasp {
  grasp::Grasp grasp;
  /// Switch of the graph that the grasp was chosen for; nullopt for start and goal.
  std::optional<search::VertexPair> chosen_for;
};

/// A sequence of steps with its static grasps.
struct CandidateSequence {
  plan::FingerGrasp initial;
  std::vector<plan::Step> steps;
  std::vector<StaticGrasp> grasps;  ///< before all steps and after each step
};

/// Return a sequence without steps: fingers 0, 1, … take the contacts of a grasp in their order.
[[nodiscard]] CandidateSequence StartOf(const grasp::Grasp& grasp);

/// Make the finger switch from one grasp to the next one.
///
/// It places new contacts with the free fingers of the lowest numbers and releases contacts that
/// are not in `after`. Contacts are equal if their points and normals are, bit for bit.
/// @throws std::invalid_argument  if the hand has too few fingers.
[[nodiscard]] plan::Switch MakeSwitch(const plan::FingerGrasp& before, const grasp::Grasp& after,
                                      int fingers);

/// Make the sequence of finger switches through given grasps with a hand of `fingers` fingers.
///
/// The contacts of the first grasp get fingers 0, 1, … in their order. Each step is a MakeSwitch; a
/// grasp that equals the previous one adds no step.
/// @throws std::invalid_argument  if there is no grasp, or the hand has too few fingers for a step.
[[nodiscard]] CandidateSequence MakeSwitchSequence(std::span<const grasp::Grasp> grasps,
                                                   int fingers);

/// Find the first step that fingers of the evaluator's hand cannot execute.
[[nodiscard]] std::optional<plan::PlanObstacle> FindObstacle(
    const CandidateSequence& candidate, const criteria::GraspEvaluator& evaluator);

/// Compute the smallest friction margin of the grasps of a sequence, radians.
[[nodiscard]] double SmallestMargin(const std::vector<StaticGrasp>& grasps,
                                    const criteria::GraspEvaluator& evaluator);

/// Name the weakest grasps of a sequence: the first one in which a fingertip has no clearance, and
/// for each criterion that is not met everywhere the grasp that violates it most.
/// @param grasps  before all steps and after each step.
[[nodiscard]] std::vector<std::string> GraspWarnings(const std::vector<StaticGrasp>& grasps,
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
