#include "planner/polygon/plan_polygon.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>

#include "planner/base/number.h"
#include "planner/graph/grasp_judge.h"
#include "planner/graph/rest_summary.h"
#include "planner/plan/same_grasp.h"
#include "planner/polygon/attached_graph.h"
#include "planner/polygon/boundary_draw.h"
#include "planner/polygon/draft.h"
#include "planner/polygon/graph_cells.h"

namespace regrasp {

namespace {

using Status = PlanResult::Status;

constexpr int kLeastContacts = 2;
constexpr int kMostDrawn = 3;  // contacts of a random grasp

/// Grasps drawn from one set, and sets looked at, before a random grasp is given up.
constexpr int kDrawsPerSet = 30;
constexpr int kMaxSetDraws = 2000;

/// Paths tried for one whose grasps are all of the quality that is asked for.
constexpr int kMaxPaths = 600;

/// Thrown inside this file for a negative answer.
struct NoGrasp {
  std::string message;
};

/// The planning of one sequence: what its stages share.
class PolygonPlanner {
 public:
  PolygonPlanner(const Polygon& polygon, GraspChoice start, GraspChoice goal,
                 const PolygonPlanOptions& options)
      : polygon_(polygon),
        options_(options),
        judge_(polygon, options.half_angle, options.min_quality),
        start_(std::move(start)),
        goal_(std::move(goal)),
        graph_(MakeGraph()),
        cells_(polygon, graph_) {}

  PlanResult Run() {
    Settle(start_, RandomUse::kStart);
    if (goal_.kind != GraspChoice::Kind::kRandom) Settle(goal_, RandomUse::kGoal);
    // Where there is nothing to do, the grasp need not be in a set.
    if (IsGoalTheStart()) return Finish(MakeDraftMaker().MakeEmpty());
    start_at_ = Attach(start_);
    if (goal_.kind == GraspChoice::Kind::kRandom) Settle(goal_, RandomUse::kGoal);
    if (IsGoalTheStart()) return Finish(MakeDraftMaker().MakeEmpty());
    goal_at_ = Attach(goal_);
    options_.progress("searching a sequence among " + std::to_string(graph_.vertex_count()) +
                      " sets of grasps");
    if (const std::optional<Draft> draft = FindDraft()) return Finish(*draft);
    PlanResult result;
    result.status = Status::kNoSequence;
    result.message = NoSequenceMessage();
    return result;
  }

 private:
  PolygonGraph MakeGraph() const {
    options_.progress("building the switching graph");
    return PolygonGraph(polygon_, options_.half_angle, options_.spanning);
  }

  [[nodiscard]] DraftMaker MakeDraftMaker() {
    return {polygon_, graph_, cells_, judge_, start_.grasp, goal_.grasp};
  }

  [[nodiscard]] bool IsGoalTheStart() const {
    return AreSameGrasp(start_.grasp, goal_.grasp, kPointTolerance * polygon_.diameter());
  }

  // Start and goal.

  /// Checks a given grasp, draws a random one.
  void Settle(GraspChoice& choice, RandomUse use) {
    const double same_point = kSamePoint * polygon_.diameter();
    if (choice.kind == GraspChoice::Kind::kGiven) {
      CheckGivenGrasp(choice, {"polygon", kLeastContacts, kPolygonFingers}, judge_.frame(),
                      options_.half_angle, same_point);
      return;
    }
    RandomStream random(options_.seed, use);
    if (choice.kind == GraspChoice::Kind::kRandom) {
      choice.grasp = DrawFromGraph(choice, use, random);
      return;
    }
    if (auto grasp = DrawAnyGrasp(polygon_, kLeastContacts, kMostDrawn, judge_, random)) {
      choice.grasp = std::move(*grasp);
      return;
    }
    throw NoGrasp{choice.name + ": none of " + std::to_string(kMaxSurfaceDraws) +
                  " grasps of 2 contacts and as many of 3 drawn on the boundary is force closure "
                  "with a quality of at least " +
                  FormatShort(options_.min_quality)};
  }

  Grasp DrawFromGraph(const GraspChoice& choice, RandomUse use, RandomStream& random) {
    std::size_t sets = 0;
    for (std::vector<int>& urn : Urns(use)) {
      sets += urn.size();
      const std::size_t draws = std::min<std::size_t>(urn.size(), kMaxSetDraws);
      for (std::size_t i = 0; i < draws; ++i) {
        std::swap(urn[i], urn[i + random.Index(urn.size() - i)]);
        for (int draw = 0; draw < kDrawsPerSet; ++draw) {
          Grasp grasp = cells_.DrawGrasp(urn[i], random);
          if (!grasp.empty() && judge_.IsGood(grasp)) return grasp;
        }
      }
    }
    throw NoGrasp{choice.name + ": no grasp with a quality of at least " +
                  FormatShort(options_.min_quality) + " was drawn from " + std::to_string(sets) +
                  " sets of grasps" + (use == RandomUse::kGoal ? " in the start's component" : "")};
  }

  /// The sets that a random grasp is drawn from, those of the first list first: a goal from the
  /// start's components, and from the start's own sets only where the others have none.
  [[nodiscard]] std::vector<std::vector<int>> Urns(RandomUse use) const {
    std::vector<int> all(graph_.vertex_count());
    std::iota(all.begin(), all.end(), 0);
    if (use == RandomUse::kStart) return {all};
    const Components components = graph_.components();
    std::set<int> reachable;
    std::set<int> own;
    for (const Attachment& a : start_at_) {
      reachable.insert(components.of_vertex[a.vertex]);
      own.insert(a.vertex);
    }
    std::erase_if(all, [&](int v) {
      return own.contains(v) || !reachable.contains(components.of_vertex[v]);
    });
    return {all, {own.begin(), own.end()}};
  }

  /// The sets that a grasp is in, or else comes to by a switch after which, or for a goal before
  /// which, the hand rests well; the best first.
  std::vector<Attachment> Attach(const GraspChoice& choice) {
    std::vector<ScoredAttachment> scored = ScoreAll(cells_.FindAttachments(choice.grasp));
    const auto is_good = [](const ScoredAttachment& a) { return a.score >= 0; };
    if (std::none_of(scored.begin(), scored.end(), is_good)) {
      std::vector<ScoredAttachment> more =
          ScoreAll(cells_.FindSwitches(choice.grasp, kPolygonFingers));
      scored.insert(scored.end(), more.begin(), more.end());
    }
    if (scored.empty()) {
      throw NoGrasp{choice.name + ": force closure, but in none of the " +
                    std::to_string(graph_.vertex_count()) +
                    " sets of concurrent, 2-finger and parallel grasps that the planner polygon "
                    "switches between, nor one switch away" +
                    CornerNote(choice.grasp)};
    }
    if (std::any_of(scored.begin(), scored.end(), is_good)) {
      std::erase_if(scored, [&](const ScoredAttachment& a) { return !is_good(a); });
    }
    std::stable_sort(scored.begin(), scored.end(),
                     [](const auto& a, const auto& b) { return a.score > b.score; });
    std::vector<Attachment> attachments;
    for (ScoredAttachment& a : scored) attachments.push_back(std::move(a.attachment));
    return attachments;
  }

  struct ScoredAttachment {
    Attachment attachment;
    double score;
  };

  /// The grasp itself is there anyway, good or not.
  [[nodiscard]] std::vector<ScoredAttachment> ScoreAll(std::vector<Attachment> attachments) const {
    std::vector<ScoredAttachment> scored;
    for (Attachment& a : attachments) {
      const double score = a.whole ? options_.half_angle : judge_.Score(GraspOf(a));
      scored.push_back({std::move(a), score});
    }
    return scored;
  }

  [[nodiscard]] Grasp GraspOf(const Attachment& attachment) const {
    Grasp grasp;
    for (const int edge : graph_.sets()[attachment.vertex].edges) {
      const auto k = static_cast<Eigen::Index>(grasp.size());
      grasp.push_back(ContactAt(polygon_, edge, attachment.parameters[k]));
    }
    return grasp;
  }

  /// Sets are open: no grasp in them has a contact at the end of an edge.
  [[nodiscard]] std::string CornerNote(const Grasp& grasp) const {
    for (std::size_t i = 0; i < grasp.size(); ++i) {
      const double to_corner = polygon_.DistanceToBorder(grasp[i].face, grasp[i].p);
      if (to_corner > kNoSlack * polygon_.diameter()) continue;
      return "; contact " + std::to_string(i) + " is at a corner, which none of them reaches";
    }
    return "";
  }

  // Search.

  /// The first sequence whose grasps are all of the quality that is asked for, otherwise the one
  /// whose weakest grasp is best: paths are tried without the switches that were too weak before.
  std::optional<Draft> FindDraft() {
    DraftMaker maker = MakeDraftMaker();
    std::optional<Draft> best;
    double best_score = -std::numeric_limits<double>::infinity();
    std::set<VertexPair> banned;
    for (int attempt = 0; attempt < kMaxPaths; ++attempt) {
      const AttachedGraph graph(graph_, start_at_, goal_at_, banned);
      const std::vector<int> path = FindSetPath(graph, cells_);
      if (path.empty()) break;
      std::optional<Draft> draft = maker.Make(path, AttachmentTo(start_at_, path.front()),
                                              AttachmentTo(goal_at_, path.back()), banned);
      if (!draft && path.size() < 2) {
        throw NoGrasp{"the align from start to goal is too narrow for doubles"};
      }
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

  /// Of the ways from a grasp to a set the best.
  static const Attachment& AttachmentTo(const std::vector<Attachment>& attachments, int vertex) {
    return *std::find_if(attachments.begin(), attachments.end(),
                         [&](const Attachment& a) { return a.vertex == vertex; });
  }

  // The answer.

  [[nodiscard]] PlanResult Finish(const Draft& draft) const {
    Plan plan;
    plan.dimension = polygon_.dimension();
    plan.half_angle = options_.half_angle;
    plan.fingers = kPolygonFingers;
    plan.planner = "polygon";
    plan.initial = draft.initial;
    plan.steps = draft.steps;
    plan.goal = goal_.grasp;
    PlanResult result;
    result.plan = std::move(plan);
    result.margin = SmallestMargin(draft.rests, judge_);
    result.warnings = QualityWarnings(draft.rests, judge_);
    return result;
  }

  [[nodiscard]] std::string NoSequenceMessage() const {
    const Components components = graph_.components();
    const auto size = [&](const std::vector<Attachment>& attachments) {
      std::set<int> reached;
      for (const Attachment& a : attachments) reached.insert(components.of_vertex[a.vertex]);
      return std::to_string(std::accumulate(
          reached.begin(), reached.end(), 0,
          [&](int sum, int component) { return sum + components.sizes[component]; }));
    };
    return "no sequence of switches and aligns leads from start to goal: of " +
           std::to_string(graph_.vertex_count()) +
           " sets of concurrent, 2-finger and parallel grasps the start's component has " +
           size(start_at_) + ", the goal's " + size(goal_at_);
  }

  const Polygon& polygon_;
  const PolygonPlanOptions& options_;
  GraspJudge judge_;
  GraspChoice start_;
  GraspChoice goal_;
  PolygonGraph graph_;
  GraphCells cells_;
  std::vector<Attachment> start_at_;
  std::vector<Attachment> goal_at_;
};

}  // namespace

PlanResult PlanOnPolygon(const Polygon& polygon, const GraspChoice& start, const GraspChoice& goal,
                         const PolygonPlanOptions& options) {
  if (!(options.min_quality >= 0)) throw std::invalid_argument("min_quality is negative");
  try {
    return PolygonPlanner(polygon, start, goal, options).Run();
  } catch (const NoGrasp& none) {
    PlanResult result;
    result.status = Status::kNoGrasp;
    result.message = none.message;
    return result;
  }
}

}  // namespace regrasp
