#include "planner/sets/polygon/plan_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>

#include "planner/base/number.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/plan/same_grasp.h"
#include "planner/planning/plan_search.h"
#include "planner/sampling/draw_grasp.h"
#include "planner/sets/polygon/attached_graph.h"
#include "planner/sets/polygon/graph_cells.h"
#include "planner/sets/polygon/graph_memory.h"
#include "planner/sets/polygon/sequence_builder.h"

namespace regrasp {

namespace {

using Status = PlanResult::Status;

constexpr int kLeastContacts = 2;
constexpr int kMostDrawn = 3;  // contacts of a random grasp

/// The planning of one sequence: what its stages share.
class PolygonPlanner {
 public:
  PolygonPlanner(const Polygon& polygon, GraspChoice start, GraspChoice goal,
                 const PolygonPlanOptions& options)
      : polygon_(polygon),
        options_(options),
        evaluator_(polygon, {options.half_angle, options.min_quality},
                   {.fingertip_radius = options.finger_radius}),
        start_(std::move(start)),
        goal_(std::move(goal)),
        graph_(MakeGraph()),
        cells_(polygon, graph_, options_.deadline) {}

  PlanResult Run() {
    Resolve(start_, RandomUse::kStart);
    if (goal_.kind != GraspChoice::Kind::kRandom) Resolve(goal_, RandomUse::kGoal);
    // Where there is nothing to do, the grasp need not be in a set.
    if (IsGoalTheStart()) return Finish(MakeBuilder().MakeEmpty());
    start_at_ = Attach(start_);
    if (goal_.kind == GraspChoice::Kind::kRandom) Resolve(goal_, RandomUse::kGoal);
    if (IsGoalTheStart()) return Finish(MakeBuilder().MakeEmpty());
    goal_at_ = Attach(goal_);
    options_.progress("searching a sequence among " + std::to_string(graph_.vertex_count()) +
                      " sets of grasps");
    if (const std::optional<CandidateSequence> draft = FindSequence()) return Finish(*draft);
    PlanResult result;
    result.status = Status::kNoSequence;
    result.message = NoSequenceMessage();
    return result;
  }

 private:
  PolygonGraph MakeGraph() const {
    options_.progress("building the switching graph");
    return {polygon_, options_.half_angle, options_.spanning, options_.deadline};
  }

  [[nodiscard]] PolygonSequenceBuilder MakeBuilder() {
    return {polygon_, graph_, cells_, evaluator_, start_.grasp, goal_.grasp};
  }

  [[nodiscard]] bool IsGoalTheStart() const {
    return AreSameGrasp(start_.grasp, goal_.grasp, kPointTolerance * polygon_.diameter());
  }

  // Start and goal.

  /// Checks a given grasp, draws a random one.
  void Resolve(GraspChoice& choice, RandomUse use) {
    const double same_point = kSamePoint * polygon_.diameter();
    if (choice.kind == GraspChoice::Kind::kGiven) {
      CheckGivenGrasp(choice, {"polygon", kLeastContacts, kPolygonFingers}, evaluator_.frame(),
                      options_.half_angle, same_point);
      CheckFingersFit(choice, polygon_, options_.finger_radius);
      return;
    }
    RandomStream random(options_.seed, use);
    if (choice.kind == GraspChoice::Kind::kRandom) {
      const auto draw = [&](int vertex) { return cells_.DrawGrasp(vertex, random); };
      SamplingPools pools = StartPools(graph_.vertex_count());
      if (use == RandomUse::kGoal) pools = GoalPools(graph_.components(), SetsOf(start_at_));
      choice.grasp = DrawFromSets(choice, std::move(pools), draw, evaluator_, random);
      return;
    }
    choice.grasp = DrawOnSurface(polygon_, {kLeastContacts, kMostDrawn}, evaluator_, random,
                                 choice.name, [&] { options_.deadline.Check(); });
  }

  static std::set<int> SetsOf(const std::vector<Attachment>& attachments) {
    std::set<int> sets;
    for (const Attachment& a : attachments) sets.insert(a.vertex);
    return sets;
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
      const double score = a.whole ? options_.half_angle : evaluator_.Score(GraspOf(a));
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

  [[nodiscard]] std::optional<CandidateSequence> FindSequence() {
    PolygonSequenceBuilder maker = MakeBuilder();
    const auto find_path = [&](const std::set<VertexPair>& banned) {
      return FindSetPath(AttachedGraph(graph_, start_at_, goal_at_, banned), cells_);
    };
    const auto make = [&](const std::vector<int>& path, std::set<VertexPair>& banned) {
      auto draft = maker.Make(path, AttachmentTo(start_at_, path.front()),
                              AttachmentTo(goal_at_, path.back()), banned);
      if (!draft && path.size() < 2) {
        throw NoGrasp{"the align from start to goal is too narrow for doubles"};
      }
      return draft;
    };
    return FindCandidate(evaluator_, find_path, make, options_.deadline);
  }

  /// Of the ways from a grasp to a set the best.
  static const Attachment& AttachmentTo(const std::vector<Attachment>& attachments, int vertex) {
    return *std::find_if(attachments.begin(), attachments.end(),
                         [&](const Attachment& a) { return a.vertex == vertex; });
  }

  // The answer.

  [[nodiscard]] PlanResult Finish(const CandidateSequence& draft) const {
    return ResultOf(draft, evaluator_, "polygon", kPolygonFingers, goal_.grasp);
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
  GraspEvaluator evaluator_;
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
    CheckMemory([&] { return EstimatePolygonGraph(polygon, options.half_angle, options.spanning); },
                options.memory);
    return PolygonPlanner(polygon, start, goal, options).Run();
  } catch (const NoGrasp& none) {
    return ResultOf(none);
  } catch (const TimeUp& time_up) {
    return ResultOf(time_up, "polygon");
  }
}

}  // namespace regrasp
