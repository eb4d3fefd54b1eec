#include "planner/sets/contour/plan_contour.h"

#include <stdexcept>

#include "planner/base/number.h"
#include "planner/plan/same_grasp.h"
#include "planner/planning/plan_search.h"
#include "planner/sampling/draw_grasp.h"
#include "planner/sets/contour/graph_memory.h"

namespace regrasp {

namespace {

using Status = PlanResult::Status;

constexpr int kContacts = 2;

/// The planning of one sequence: what its stages share.
class ContourPlanner {
 public:
  ContourPlanner(const Polygon& polygon, GraspChoice start, GraspChoice goal,
                 const ContourPlanOptions& options)
      : polygon_(polygon),
        options_(options),
        evaluator_(polygon, {options.half_angle, options.min_quality},
                   {.fingertip_radius = options.finger_radius}),
        start_choice_(std::move(start)),
        goal_choice_(std::move(goal)),
        graph_(MakeGraph()),
        geometry_(graph_, options_.deadline) {}

  PlanResult Run() {
    RandomStream of_start(options_.seed, RandomUse::kStart);
    RandomStream of_goal(options_.seed, RandomUse::kGoal);
    Resolve(start_choice_, of_start);
    if (goal_choice_.kind != GraspChoice::Kind::kRandom) {
      Resolve(goal_choice_, of_goal);
      // Where there is nothing to do, the grasp need not be in a set.
      if (IsGoalTheStart()) return FinishEmpty();
      start_ = Locate(start_choice_);
      return PlanToGoal();
    }
    start_ = Locate(start_choice_);
    return PlanToRandomGoal([&](bool last) {
      goal_pools_ = GoalPools(graph_.components(), {graph_.set_of(start_->at.piece)});
      if (last) goal_pools_.erase(goal_pools_.begin());
      Resolve(goal_choice_, of_goal);
      return IsGoalTheStart() ? FinishEmpty() : PlanToGoal();
    });
  }

 private:
  ContourGraph MakeGraph() const {
    options_.progress("building the switching graph");
    return {polygon_, options_.half_angle, options_.deadline};
  }

  [[nodiscard]] bool IsGoalTheStart() const {
    return AreSameGrasp(start_choice_.grasp, goal_choice_.grasp,
                        kPointTolerance * polygon_.diameter());
  }

  PlanResult PlanToGoal() {
    goal_ = Locate(goal_choice_);
    options_.progress("searching a sequence among " + std::to_string(graph_.vertex_count()) +
                      " sets of grasps");
    ContourSequenceBuilder maker(geometry_, evaluator_, options_.aim, *start_, *goal_);
    const auto draft = FindCandidate(
        evaluator_, [&](const auto& banned) { return FindPath(banned); },
        [&](const auto& path, auto& banned) { return maker.Make(path, banned); },
        options_.deadline);
    if (draft) return Finish(*draft);
    PlanResult result;
    result.status = Status::kNoSequence;
    result.message = NoSequenceMessage();
    return result;
  }

  // Start and goal.

  /// Checks a given grasp, draws a random one.
  void Resolve(GraspChoice& choice, RandomStream& random) {
    if (choice.kind == GraspChoice::Kind::kGiven) {
      CheckGivenGrasp(choice, {"contour", kContacts, kContacts}, evaluator_.frame(),
                      options_.half_angle, kSamePoint * polygon_.diameter());
      CheckFingersFit(choice, polygon_, options_.finger_radius);
      return;
    }
    if (choice.kind == GraspChoice::Kind::kRandom) {
      const auto draw = [&](int set) {
        const auto placed = geometry_.Draw(set, random);
        return placed ? geometry_.GraspOf(*placed) : Grasp();
      };
      const bool is_goal = !goal_pools_.empty();
      choice.grasp = DrawFromSets(choice, is_goal ? goal_pools_ : StartPools(graph_.vertex_count()),
                                  draw, evaluator_, random);
      return;
    }
    choice.grasp = DrawOnSurface(polygon_, {kContacts, kContacts}, evaluator_, random, choice.name,
                                 [&] { options_.deadline.Check(); });
  }

  [[nodiscard]] ContourSequenceBuilder::End Locate(const GraspChoice& choice) const {
    const auto placed = geometry_.Locate(choice.grasp);
    if (!placed) {
      throw NoGrasp{choice.name + ": force closure, but too near to its limit: in none of the " +
                    std::to_string(graph_.vertex_count()) + " sets of 2-finger grasps"};
    }
    return {choice.grasp, *placed};
  }

  /// The sets of a sequence with the fewest switches, of these the widest.
  [[nodiscard]] std::vector<int> FindPath(const std::set<VertexPair>& banned) {
    return FindWidePath(GraphWithout(graph_, banned), graph_.set_of(start_->at.piece),
                        graph_.set_of(goal_->at.piece),
                        [&](int set) { return geometry_.WidthOf(set); });
  }

  // The answer.

  [[nodiscard]] PlanResult FinishEmpty() {
    const ContourSequenceBuilder::End none = {start_choice_.grasp, {}};
    return Finish(
        ContourSequenceBuilder(geometry_, evaluator_, options_.aim, none, none).MakeEmpty());
  }

  [[nodiscard]] PlanResult Finish(const CandidateSequence& draft) const {
    return ResultOf(draft, evaluator_, "contour", kContourFingers, goal_choice_.grasp);
  }

  [[nodiscard]] std::string NoSequenceMessage() const {
    const Components components = graph_.components();
    const auto size = [&](const ContourSequenceBuilder::End& end) {
      return std::to_string(components.sizes[components.of_vertex[graph_.set_of(end.at.piece)]]);
    };
    return "no sequence of switches and aligns leads from start to goal: of " +
           std::to_string(graph_.vertex_count()) +
           " sets of 2-finger grasps the start's component has " + size(*start_) + ", the goal's " +
           size(*goal_);
  }

  const Polygon& polygon_;
  const ContourPlanOptions& options_;
  GraspEvaluator evaluator_;
  GraspChoice start_choice_;
  GraspChoice goal_choice_;
  SamplingPools goal_pools_;  ///< that a random goal is drawn from
  ContourGraph graph_;
  SetGeometry geometry_;
  std::optional<ContourSequenceBuilder::End> start_;
  std::optional<ContourSequenceBuilder::End> goal_;
};

}  // namespace

PlanResult PlanOnContour(const Polygon& polygon, const GraspChoice& start, const GraspChoice& goal,
                         const ContourPlanOptions& options) {
  if (!(options.min_quality >= 0)) throw std::invalid_argument("min_quality is negative");
  try {
    CheckMemory([&] { return EstimateContourPlan(polygon, options.half_angle); }, options.memory);
    return ContourPlanner(polygon, start, goal, options).Run();
  } catch (const NoGrasp& none) {
    return ResultOf(none);
  } catch (const TimeUp& time_up) {
    return ResultOf(time_up, "contour");
  }
}

}  // namespace regrasp
