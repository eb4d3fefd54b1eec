#include "planner/gait/goal_list.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "planner/base/error.h"
#include "planner/gait/find_gait.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/plan/projection.h"

namespace regrasp::gait {

namespace {

/// Maximum number of end states per goal and previous end state. With a time limit, end states of
/// the first goal are searched until it.
constexpr int kEndStates = 3;
/// Maximum number of searches per goal of the list without a time limit.
constexpr std::size_t kSearchesPerGoal = 6;
/// Random streams of end states are this many bits apart; FindExecutableGait uses lower ones.
constexpr int kEndStateShift = 48;
/// Look-ahead: expanded stances, and fraction of the remaining time.
constexpr std::int64_t kLookAheadExpanded = 150;
constexpr double kLookAheadTime = 0.1;
/// Fraction of the remaining time for the last goal, and for all goals but the first together. The
/// rest is for other end states.
constexpr double kLastGoalTime = 0.4;
constexpr double kLaterGoalsTime = 0.5;

/// Plan up to one of the goals.
struct Prefix {
  std::optional<plan::Plan> plan;  ///< nullopt before the first goal
  std::optional<planning::ExecutionResult> execution = {};
};

/// Simulate a plan after the steps of another one; counts the steps of the plan only.
auto SimulatorAfter(const GaitRequest& request, const plan::Plan& before,
                    const plan::NamedGoal& goal) {
  return [simulate = request.simulate, before, goal](const plan::Plan& plan,
                                                     const Deadline& deadline) {
    auto execution = simulate(Joined(before, plan, goal), deadline);
    if (!execution) return execution;
    execution->steps -= static_cast<int>(before.steps.size());
    if (execution->steps < 0) execution->is_held = false;
    execution->steps = std::max(0, execution->steps);
    return execution;
  };
}

/// Rate a plan together with the steps before it.
auto RaterAfter(const GaitRequest& request, const plan::Plan& before, const plan::NamedGoal& goal) {
  return [rate = request.rate, before, goal](const plan::Plan& plan, int most_failures,
                                             const Deadline& deadline) {
    return rate(Joined(before, plan, goal), most_failures, deadline);
  };
}

class GoalListSearch {
 public:
  explicit GoalListSearch(const GaitRequest& request) : request_(request) {}

  GoalListResult Run() {
    Prefix nothing{std::nullopt};
    if (Extend(0, nothing)) return {std::move(found_.plan), std::move(found_.execution), ""};
    return {std::nullopt, std::move(failed_execution_), FailureText()};
  }

 private:
  /// Reach the remaining goals; `found_` is the result.
  bool Extend(std::size_t goal, const Prefix& before) {
    if (goal == request_.goals.size()) {
      found_ = before;
      return true;
    }
    std::vector<Prefix> postponed;
    const bool draws_on = goal == 0 && request_.goals.size() > 1 && request_.deadline.left();
    for (int draw = 0; (draw < kEndStates || draws_on) && !IsOver(); ++draw) {
      std::optional<Prefix> end = Reach(goal, before, draw);
      if (!end && draws_on && was_cut_short_) continue;
      if (!end) break;
      const bool is_last = goal + 1 == request_.goals.size();
      if (is_last || SeesNext(goal + 1, *end)) {
        if (Extend(goal + 1, *end)) return true;
      } else {
        postponed.push_back(*std::move(end));
      }
      // After the usual number of end states none is postponed any longer.
      if (draw + 1 >= kEndStates && ExtendAny(goal + 1, postponed)) return true;
    }
    return ExtendAny(goal + 1, postponed);
  }

  /// Reach the remaining goals from one of the end states, which are used up.
  bool ExtendAny(std::size_t goal, std::vector<Prefix>& ends) {
    const std::vector<Prefix> tried = std::exchange(ends, {});
    return std::ranges::any_of(tried,
                               [&](const Prefix& end) { return !IsOver() && Extend(goal, end); });
  }

  [[nodiscard]] bool IsOver() const {
    if (request_.deadline.left()) return request_.deadline.IsOver();
    return searches_ >= kSearchesPerGoal * request_.goals.size();
  }

  /// Return the request for one goal from the end of the previous one.
  [[nodiscard]] GaitRequest RequestFor(std::size_t goal, const Prefix& before) const {
    GaitRequest request = request_;
    request.goals.clear();
    request.goal = request_.goals[goal].set;
    if (!before.plan) return request;
    const plan::HandEnd end = plan::EndOfPlan(*before.plan);
    if (before.plan->steps.empty() && request_.start_grasp.empty()) {
      // No step requires the initial grasp that was found for the earlier goals.
      request.start_pose = end.state.pose;
    } else {
      StartFrom(end, request);
      request.start_grasp.clear();
      for (const plan::FingerContact& held : end.grasp) {
        // Contacts that have rolled have no face yet.
        request.start_grasp.push_back(plan::ProjectContact(*request_.solid, held.contact).contact);
      }
    }
    if (request.simulate) {
      request.simulate = SimulatorAfter(request_, *before.plan, request_.goals[goal]);
    }
    if (request.rate) request.rate = RaterAfter(request_, *before.plan, request_.goals[goal]);
    // No plan executes after a part that does not.
    if (before.execution && !before.execution->is_whole)
      request.robustness = RobustnessLevel::kNone;
    return request;
  }

  /// Return the fraction of the remaining time for a goal.
  [[nodiscard]] double TimeFor(std::size_t goal) const {
    const std::size_t left = request_.goals.size() - goal;
    if (request_.goals.size() == 1) return 1;
    if (goal == 0) return 1.0 / (1.0 + static_cast<double>(left));
    return left == 1 ? kLastGoalTime : kLaterGoalsTime / static_cast<double>(left);
  }

  /// Find a plan from the end of the previous goal to a goal.
  std::optional<Prefix> Reach(std::size_t goal, const Prefix& before, int draw) {
    ++searches_;
    GaitRequest request = RequestFor(goal, before);
    request.seed += static_cast<std::uint64_t>(draw) << kEndStateShift;
    request.deadline = request_.deadline.After(TimeFor(goal));
    request.progress = [&](std::string_view text) {
      request_.progress("goal " + std::to_string(goal + 1) + " of " +
                        std::to_string(request_.goals.size()) + ": " + std::string(text));
    };
    const GaitResult found = FindFor(goal, request);
    was_cut_short_ = !found.gait && request.deadline.IsOver();
    if (!found.gait) {
      Note(goal, found);
      return std::nullopt;
    }
    const plan::Plan plan = PlanOf(*found.gait, request, found.contacts);
    reached_ = std::max(reached_, goal + 1);
    Prefix end{Joined(before.plan, plan, request_.goals[goal]), found.execution};
    if (!end.execution) {
      end.execution = before.execution;
    } else if (before.plan && end.execution->is_held) {
      end.execution->steps += static_cast<int>(before.plan->steps.size());
    }
    return end;
  }

  /// @throws InputError  as FindGait, with the name of the goal.
  [[nodiscard]] GaitResult FindFor(std::size_t goal, const GaitRequest& request) const {
    try {
      return FindGait(request);
    } catch (const InputError& error) {
      throw InputError("goal " + std::to_string(goal + 1) + " (" + request_.goals[goal].name +
                       "): " + error.what());
    }
  }

  /// Return whether a short search without simulation reaches a goal.
  [[nodiscard]] bool SeesNext(std::size_t goal, const Prefix& before) const {
    GaitRequest request = RequestFor(goal, before);
    request.robustness = RobustnessLevel::kNone;
    request.simulate = nullptr;
    request.names_causes = false;
    request.most_expanded = std::min(request.most_expanded, kLookAheadExpanded);
    request.deadline = request_.deadline.After(kLookAheadTime);
    return FindFor(goal, request).gait.has_value();
  }

  /// Record why a goal is not reached; the farthest goal counts.
  void Note(std::size_t goal, const GaitResult& found) {
    if (goal < reached_ || (!failure_.empty() && goal < failed_goal_)) return;
    failed_goal_ = goal;
    failure_ = found.message;
    failed_execution_ = found.execution;
  }

  [[nodiscard]] std::string FailureText() const {
    // Without a failed search for the first unreached goal there was no time for one.
    const bool was_searched = !failure_.empty() && failed_goal_ >= reached_;
    const std::string reason = was_searched ? failure_ : "no initial pose was searched";
    if (request_.goals.size() == 1) return reason;
    const std::size_t goal = std::max(failed_goal_, reached_);
    std::string text = "goal " + std::to_string(goal + 1) + " of " +
                       std::to_string(request_.goals.size()) + " (" + request_.goals[goal].name +
                       ") is not reached";
    if (goal > 0) {
      text += " from " + std::to_string(searches_) + " searches over end states of earlier goals";
    }
    return text + ": " + reason;
  }

  const GaitRequest& request_;
  Prefix found_;
  std::size_t searches_ = 0;
  bool was_cut_short_ = false;  ///< the last search failed at its time limit
  std::size_t reached_ = 0;     ///< number of goals that some plan reaches
  std::size_t failed_goal_ = 0;
  std::string failure_;
  std::optional<planning::ExecutionResult> failed_execution_;
};

}  // namespace

plan::Plan Joined(const std::optional<plan::Plan>& before, const plan::Plan& after,
                  const plan::NamedGoal& goal) {
  plan::Plan plan = before && !before->steps.empty() ? *before : after;
  if (!before) {
    plan.hand->goals.clear();
  } else if (before->steps.empty()) {
    plan.hand->goals = before->hand->goals;
  } else {
    plan.steps.insert(plan.steps.end(), after.steps.begin(), after.steps.end());
    plan.goal = after.goal;
    plan.hand->goal = after.hand->goal;
  }
  plan.hand->goals.push_back({goal.name, static_cast<int>(plan.steps.size()), goal.set});
  return plan;
}

void StartFrom(const plan::HandEnd& end, planning::InHandTask& task) {
  task.start_pose = end.state.pose;
  task.start_joints = end.state.joints;
  task.start_fingers.clear();
  for (const plan::FingerContact& held : end.grasp) task.start_fingers.push_back(held.finger);
}

void EndAt(const plan::HandEnd& end, const plan::PoseTolerance& tolerance,
           planning::InHandTask& task) {
  task.goal.emplace(plan::PoseGoal{end.state.pose, tolerance});
  task.goal_fingers.clear();
  for (const plan::FingerContact& held : end.grasp) task.goal_fingers.push_back(held.finger);
}

GoalListResult FindPlanThroughGoals(const GaitRequest& request) {
  return GoalListSearch(request).Run();
}

}  // namespace regrasp::gait
