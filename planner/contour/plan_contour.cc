#include "planner/contour/plan_contour.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "planner/base/number.h"
#include "planner/graph/fewest_switches.h"
#include "planner/graph/rest_summary.h"
#include "planner/graph/widest_path.h"
#include "planner/plan/same_grasp.h"
#include "planner/polygon/boundary_draw.h"

namespace regrasp {

namespace {

using Status = PlanResult::Status;

constexpr int kContacts = 2;

/// Grasps drawn from one set, and sets looked at, before a random grasp is given up.
constexpr int kDrawsPerSet = 30;
constexpr std::size_t kMaxSetDraws = 2000;

/// Paths tried for one whose grasps are all of the quality that is asked for.
constexpr int kMaxPaths = 600;

/// Thrown inside this file for a negative answer.
struct NoGrasp {
  std::string message;
};

/// A graph without some of its edges.
class GraphWithout final : public SwitchingGraph {
 public:
  GraphWithout(const SwitchingGraph& graph, const std::set<VertexPair>& banned)
      : graph_(graph), banned_(banned) {}

  [[nodiscard]] int vertex_count() const override { return graph_.vertex_count(); }
  void GetNeighbours(int vertex, std::vector<int>& neighbours) const override {
    graph_.GetNeighbours(vertex, neighbours);
    std::erase_if(neighbours, [&](int w) { return banned_.contains(Unordered(vertex, w)); });
  }

 private:
  const SwitchingGraph& graph_;
  const std::set<VertexPair>& banned_;
};

/// The planning of one sequence: what its stages share.
class ContourPlanner {
 public:
  ContourPlanner(const Polygon& polygon, GraspChoice start, GraspChoice goal,
                 const ContourPlanOptions& options)
      : polygon_(polygon),
        options_(options),
        judge_(polygon, options.half_angle, options.min_quality),
        start_choice_(std::move(start)),
        goal_choice_(std::move(goal)),
        graph_(MakeGraph()),
        geometry_(graph_) {}

  PlanResult Run() {
    Settle(start_choice_, RandomUse::kStart);
    if (goal_choice_.kind != GraspChoice::Kind::kRandom) Settle(goal_choice_, RandomUse::kGoal);
    // Where there is nothing to do, the grasp need not be in a set.
    if (IsGoalTheStart()) return FinishEmpty();
    start_ = Locate(start_choice_);
    if (goal_choice_.kind == GraspChoice::Kind::kRandom) Settle(goal_choice_, RandomUse::kGoal);
    if (IsGoalTheStart()) return FinishEmpty();
    goal_ = Locate(goal_choice_);
    options_.progress("searching a sequence among " + std::to_string(graph_.vertex_count()) +
                      " sets of grasps");
    if (const std::optional<Draft> draft = FindDraft()) return Finish(*draft);
    PlanResult result;
    result.status = Status::kNoSequence;
    result.message = NoSequenceMessage();
    return result;
  }

 private:
  ContourGraph MakeGraph() const {
    options_.progress("building the switching graph");
    return {polygon_, options_.half_angle};
  }

  [[nodiscard]] bool IsGoalTheStart() const {
    return AreSameGrasp(start_choice_.grasp, goal_choice_.grasp,
                        kPointTolerance * polygon_.diameter());
  }

  // Start and goal.

  /// Checks a given grasp, draws a random one.
  void Settle(GraspChoice& choice, RandomUse use) {
    if (choice.kind == GraspChoice::Kind::kGiven) {
      CheckGivenGrasp(choice, {"contour", kContacts, kContacts}, judge_.frame(),
                      options_.half_angle, kSamePoint * polygon_.diameter());
      return;
    }
    RandomStream random(options_.seed, use);
    if (choice.kind == GraspChoice::Kind::kRandom) {
      choice.grasp = DrawFromGraph(choice, use, random);
      return;
    }
    auto grasp = DrawAnyGrasp(polygon_, kContacts, kContacts, judge_, random);
    if (!grasp) {
      throw NoGrasp{choice.name + ": none of " + std::to_string(kMaxSurfaceDraws) +
                    " grasps of 2 contacts drawn on the boundary is force closure with a quality "
                    "of at least " +
                    FormatShort(options_.min_quality)};
    }
    choice.grasp = std::move(*grasp);
  }

  Grasp DrawFromGraph(const GraspChoice& choice, RandomUse use, RandomStream& random) {
    std::size_t sets = 0;
    for (std::vector<int>& urn : Urns(use)) {
      sets += urn.size();
      const std::size_t draws = std::min(urn.size(), kMaxSetDraws);
      for (std::size_t i = 0; i < draws; ++i) {
        std::swap(urn[i], urn[i + random.Index(urn.size() - i)]);
        for (int draw = 0; draw < kDrawsPerSet; ++draw) {
          const auto placed = geometry_.Draw(urn[i], random);
          if (!placed) break;
          Grasp grasp = geometry_.GraspOf(*placed);
          if (judge_.IsGood(grasp)) return grasp;
        }
      }
    }
    throw NoGrasp{choice.name + ": no grasp with a quality of at least " +
                  FormatShort(options_.min_quality) + " was drawn from " + std::to_string(sets) +
                  " sets of grasps" + (use == RandomUse::kGoal ? " in the start's component" : "")};
  }

  /// The sets that a random grasp is drawn from, those of the first list first: a goal from the
  /// start's component, and from the start's own set only where the others have none.
  [[nodiscard]] std::vector<std::vector<int>> Urns(RandomUse use) const {
    std::vector<int> all(graph_.vertex_count());
    std::iota(all.begin(), all.end(), 0);
    if (use == RandomUse::kStart) return {all};
    const Components components = graph_.components();
    const int own = graph_.set_of(start_->at.piece);
    std::erase_if(all, [&](int v) {
      return v == own || components.of_vertex[v] != components.of_vertex[own];
    });
    return {all, {own}};
  }

  [[nodiscard]] ContourDraftMaker::End Locate(const GraspChoice& choice) const {
    const auto placed = geometry_.Locate(choice.grasp);
    if (!placed) {
      throw NoGrasp{choice.name + ": force closure, but too near to its limit: in none of the " +
                    std::to_string(graph_.vertex_count()) + " sets of 2-finger grasps"};
    }
    return {choice.grasp, *placed};
  }

  // Search.

  /// The first sequence whose grasps are all of the quality that is asked for, otherwise the one
  /// whose weakest grasp is best: paths are tried without the switches that were too weak before.
  std::optional<Draft> FindDraft() {
    ContourDraftMaker maker(geometry_, judge_, options_.aim, *start_, *goal_);
    std::optional<Draft> best;
    double best_score = -std::numeric_limits<double>::infinity();
    std::set<VertexPair> banned;
    for (int attempt = 0; attempt < kMaxPaths; ++attempt) {
      const std::vector<int> path = FindPath(banned);
      if (path.empty()) break;
      std::optional<Draft> draft = maker.Make(path, banned);
      if (!draft) continue;
      double score = std::numeric_limits<double>::infinity();
      for (const Rest& rest : draft->rests) {
        if (!rest.chosen_for) continue;
        const double of_rest = judge_.Score(rest.grasp);
        if (of_rest < 0) banned.insert(*rest.chosen_for);
        score = std::min(score, of_rest);
      }
      if (score >= 0) return draft;
      if (best && score <= best_score) continue;
      best = std::move(draft);
      best_score = score;
    }
    return best;
  }

  /// The sets of a sequence with the fewest switches, of these the widest.
  [[nodiscard]] std::vector<int> FindPath(const std::set<VertexPair>& banned) {
    const GraphWithout graph(graph_, banned);
    const int from = graph_.set_of(start_->at.piece);
    const int to = graph_.set_of(goal_->at.piece);
    const VertexFilter all = [](int) { return true; };
    const auto switches = FewestSwitches(graph, from, to, all);
    if (!switches) return {};
    return WidestPath(graph, from, to, *switches, all,
                      [&](int set) { return geometry_.WidthOf(set); });
  }

  // The answer.

  [[nodiscard]] PlanResult FinishEmpty() const {
    const ContourDraftMaker::End none = {start_choice_.grasp, {}};
    SetGeometry geometry(graph_);
    return Finish(ContourDraftMaker(geometry, judge_, options_.aim, none, none).MakeEmpty());
  }

  [[nodiscard]] PlanResult Finish(const Draft& draft) const {
    Plan plan;
    plan.dimension = polygon_.dimension();
    plan.half_angle = options_.half_angle;
    plan.fingers = kContourFingers;
    plan.planner = "contour";
    plan.initial = draft.initial;
    plan.steps = draft.steps;
    plan.goal = goal_choice_.grasp;
    PlanResult result;
    result.plan = std::move(plan);
    result.margin = SmallestMargin(draft.rests, judge_);
    result.warnings = QualityWarnings(draft.rests, judge_);
    return result;
  }

  [[nodiscard]] std::string NoSequenceMessage() const {
    const Components components = graph_.components();
    const auto size = [&](const ContourDraftMaker::End& end) {
      return std::to_string(components.sizes[components.of_vertex[graph_.set_of(end.at.piece)]]);
    };
    return "no sequence of switches and aligns leads from start to goal: of " +
           std::to_string(graph_.vertex_count()) +
           " sets of 2-finger grasps the start's component has " + size(*start_) + ", the goal's " +
           size(*goal_);
  }

  const Polygon& polygon_;
  const ContourPlanOptions& options_;
  GraspJudge judge_;
  GraspChoice start_choice_;
  GraspChoice goal_choice_;
  ContourGraph graph_;
  SetGeometry geometry_;
  std::optional<ContourDraftMaker::End> start_;
  std::optional<ContourDraftMaker::End> goal_;
};

}  // namespace

PlanResult PlanOnContour(const Polygon& polygon, const GraspChoice& start, const GraspChoice& goal,
                         const ContourPlanOptions& options) {
  if (!(options.min_quality >= 0)) throw std::invalid_argument("min_quality is negative");
  try {
    return ContourPlanner(polygon, start, goal, options).Run();
  } catch (const NoGrasp& none) {
    PlanResult result;
    result.status = Status::kNoGrasp;
    result.message = none.message;
    return result;
  }
}

}  // namespace regrasp
