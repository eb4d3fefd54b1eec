#include "planner/polygon/plan_polygon.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

#include "planner/base/number.h"
#include "planner/graph/fewest_switches.h"
#include "planner/graph/sequence.h"
#include "planner/graph/widest_path.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "planner/grasp/required_half_angle.h"
#include "planner/plan/same_grasp.h"
#include "planner/polygon/align_path.h"
#include "planner/polygon/graph_cells.h"
#include "planner/polygon/switch_point.h"

namespace regrasp {

namespace {

using Eigen::VectorXd;
using Status = PlanResult::Status;
using VertexPair = std::pair<int, int>;

constexpr int kLeastContacts = 2;

/// Grasps drawn from one set, and sets looked at, before a random grasp is given up.
constexpr int kDrawsPerSet = 30;
constexpr int kMaxSetDraws = 2000;

/// Paths tried for one whose grasps are all of the quality that is asked for.
constexpr int kMaxPaths = 600;

/// A switch from the grasp at hand, or to the goal's, or one that keeps more contacts is good
/// enough with this share of the best one's score: it spares an align or a move.
constexpr double kGoodShare = 0.5;

/// Of required half-angles that are only compared, radians.
constexpr double kScoreAccuracy = 1e-5;

/// Thrown inside this file for a negative answer.
struct NoGrasp {
  std::string message;
};

VertexPair Unordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// The graph with two more vertices, the start and the goal, and without some switches.
class AttachedGraph final : public SwitchingGraph {
 public:
  AttachedGraph(const PolygonGraph& graph, const std::vector<Attachment>& start,
                const std::vector<Attachment>& goal, const std::set<VertexPair>& banned)
      : graph_(graph), banned_(banned) {
    for (const Attachment& a : start) starts_.insert(a.vertex);
    for (const Attachment& a : goal) goals_.insert(a.vertex);
  }

  [[nodiscard]] int start() const { return graph_.vertex_count(); }
  [[nodiscard]] int goal() const { return graph_.vertex_count() + 1; }
  [[nodiscard]] int vertex_count() const override { return graph_.vertex_count() + 2; }
  void GetNeighbours(int vertex, std::vector<int>& neighbours) const override {
    if (vertex == start() || vertex == goal()) {
      const std::set<int>& attached = vertex == start() ? starts_ : goals_;
      neighbours.assign(attached.begin(), attached.end());
      return;
    }
    graph_.GetNeighbours(vertex, neighbours);
    if (!banned_.empty()) {
      std::erase_if(neighbours,
                    [&](int other) { return banned_.contains(Unordered(vertex, other)); });
    }
    if (starts_.contains(vertex)) neighbours.push_back(start());
    if (goals_.contains(vertex)) neighbours.push_back(goal());
  }

 private:
  const PolygonGraph& graph_;
  const std::set<VertexPair>& banned_;
  std::set<int> starts_;
  std::set<int> goals_;
};

/// A sequence and what is known of it.
struct Draft {
  FingerGrasp initial;
  std::vector<Step> steps;
  std::vector<Grasp> rests;              ///< the grasp before all steps and after each
  std::vector<VertexPair> bad_switches;  ///< whose grasps are below the quality that is asked for
};

/// The planning of one sequence: what its stages share.
class PolygonPlanner {
 public:
  PolygonPlanner(const Polygon& polygon, GraspChoice start, GraspChoice goal,
                 const PolygonPlanOptions& options)
      : polygon_(polygon),
        options_(options),
        frame_(polygon.wrench_frame()),
        start_(std::move(start)),
        goal_(std::move(goal)),
        graph_(MakeGraph()),
        cells_(polygon, graph_) {}

  PlanResult Run() {
    Settle(start_, RandomUse::kStart);
    start_at_ = Attach(start_);
    Settle(goal_, RandomUse::kGoal);
    goal_at_ = Attach(goal_);
    PlanResult result;
    if (AreSameGrasp(start_.grasp, goal_.grasp, kPointTolerance * polygon_.diameter())) {
      Draft nothing;
      Begin(nothing);
      Finish(nothing, result);
      return result;
    }
    options_.progress("searching a sequence among " + std::to_string(graph_.vertex_count()) +
                      " sets of grasps");
    const std::optional<Draft> draft = FindDraft();
    if (draft) {
      Finish(*draft, result);
    } else {
      result.status = Status::kNoSequence;
      result.message = NoSequenceMessage();
    }
    return result;
  }

 private:
  PolygonGraph MakeGraph() const {
    options_.progress("building the switching graph");
    return PolygonGraph(polygon_, options_.half_angle, options_.spanning);
  }

  [[nodiscard]] bool IsGood(const Grasp& grasp) const {
    return IsForceClosure(grasp, frame_, options_.half_angle) &&
           QualityAtLeast(grasp, frame_, options_.half_angle, options_.min_quality);
  }

  // Start and goal.

  /// Checks a given grasp, draws a random one.
  void Settle(GraspChoice& choice, RandomUse use) {
    const double same_point = kSamePoint * polygon_.diameter();
    if (choice.kind == GraspChoice::Kind::kGiven) {
      CheckGivenGrasp(choice, {"polygon", kLeastContacts, kPolygonFingers}, frame_,
                      options_.half_angle, same_point);
      return;
    }
    RandomStream random(options_.seed, use);
    if (choice.kind == GraspChoice::Kind::kRandom) {
      choice.grasp = DrawFromGraph(choice, use, random);
      return;
    }
    const int contacts = kLeastContacts + static_cast<int>(random.Index(2));
    const auto grasp = DrawGoodGrasp([&] { return DrawOnBoundary(contacts, random); }, frame_,
                                     options_.half_angle, options_.min_quality, same_point);
    if (!grasp) {
      throw NoGrasp{choice.name + ": none of " + std::to_string(kMaxSurfaceDraws) + " grasps of " +
                    std::to_string(contacts) +
                    " contacts drawn on the boundary is force closure with a quality of at least " +
                    FormatShort(options_.min_quality)};
    }
    choice.grasp = *grasp;
  }

  [[nodiscard]] Grasp DrawOnBoundary(int contacts, RandomStream& random) const {
    double perimeter = 0;
    for (int e = 0; e < polygon_.face_count(); ++e) perimeter += polygon_.face_measure(e);
    Grasp grasp;
    while (static_cast<int>(grasp.size()) < contacts) {
      double along = random.Uniform() * perimeter;
      int edge = 0;
      while (edge + 1 < polygon_.face_count() && along >= polygon_.face_measure(edge)) {
        along -= polygon_.face_measure(edge++);
      }
      grasp.push_back(
          ContactAt(polygon_, edge, std::min(along / polygon_.face_measure(edge), 1.0)));
    }
    return grasp;
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
          if (!grasp.empty() && IsGood(grasp)) return grasp;
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

  std::vector<Attachment> Attach(const GraspChoice& choice) {
    std::vector<Attachment> attachments = cells_.FindAttachments(choice.grasp);
    if (attachments.empty()) {
      throw NoGrasp{choice.name + ": force closure, but in none of the " +
                    std::to_string(graph_.vertex_count()) +
                    " sets of concurrent, 2-finger and parallel grasps that the planner polygon "
                    "switches between"};
    }
    // A start that must release fingers first, or a goal that places some last, should rest well
    // without them too.
    const auto rests_well = [&](const Attachment& a) {
      return a.contacts.size() == choice.grasp.size() || IsGood(ContactsOf(choice.grasp, a));
    };
    if (std::any_of(attachments.begin(), attachments.end(), rests_well)) {
      std::erase_if(attachments, [&](const Attachment& a) { return !rests_well(a); });
    }
    return attachments;
  }

  // Search.

  std::optional<Draft> FindDraft() {
    std::optional<Draft> first;
    std::set<VertexPair> banned;
    for (int attempt = 0; attempt < kMaxPaths; ++attempt) {
      const std::vector<int> path = FindPath(banned);
      if (path.empty()) break;
      std::optional<Draft> draft = MakeDraft(path, banned);
      if (!draft) continue;
      if (draft->bad_switches.empty()) return draft;
      banned.insert(draft->bad_switches.begin(), draft->bad_switches.end());
      if (!first) first = std::move(draft);
    }
    return first;
  }

  /// The sets that a sequence passes; empty where there is none.
  std::vector<int> FindPath(const std::set<VertexPair>& banned) {
    const AttachedGraph graph(graph_, start_at_, goal_at_, banned);
    const VertexFilter all = [](int) { return true; };
    const auto switches = FewestSwitches(graph, graph.start(), graph.goal(), all);
    if (!switches) return {};
    std::vector<int> path = WidestPath(graph, graph.start(), graph.goal(), *switches, all,
                                       [&](int vertex) { return cells_.of(vertex).width(); });
    path.erase(path.begin());
    path.pop_back();
    return path;
  }

  /// Of the ways in which a grasp belongs to a set, the one with the most contacts.
  static const Attachment& AttachmentTo(const std::vector<Attachment>& attachments, int vertex) {
    return *std::find_if(attachments.begin(), attachments.end(),
                         [&](const Attachment& a) { return a.vertex == vertex; });
  }

  // From a path to a sequence.

  /// @returns nullopt where doubles find no switch or align that the graph has; then the switch is
  ///          banned.
  std::optional<Draft> MakeDraft(const std::vector<int>& path, std::set<VertexPair>& banned) {
    const Attachment& start = AttachmentTo(start_at_, path.front());
    const Attachment& goal = AttachmentTo(goal_at_, path.back());
    Draft draft;
    Begin(draft);
    SwitchTo(draft, ContactsOf(start_.grasp, start));
    VectorXd at = start.parameters;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const bool last = i + 2 == path.size();
      const auto [point, good] = ChooseSwitch(path[i], path[i + 1], at, last ? &goal : nullptr);
      const bool reached = point && AlignTo(draft, path[i], at, point->before);
      if (!reached) {
        banned.insert(Unordered(path[i], path[i + 1]));
        return std::nullopt;
      }
      if (!good) draft.bad_switches.push_back(Unordered(path[i], path[i + 1]));
      SwitchTo(draft, GraspAt(graph_.sets()[path[i + 1]], point->after));
      at = point->after;
    }
    if (!AlignTo(draft, path.back(), at, goal.parameters)) {
      if (path.size() < 2) throw NoGrasp{"the align from start to goal is too narrow for doubles"};
      banned.insert(Unordered(path[path.size() - 2], path.back()));
      return std::nullopt;
    }
    SwitchTo(draft, goal_.grasp);
    return draft;
  }

  struct ChosenSwitch {
    std::optional<SwitchPoint> point;
    bool good = false;  ///< both grasps are of the quality that is asked for
  };

  /// The switch between two sets: from the grasp at hand and to the goal's where that costs little,
  /// otherwise the best there is.
  ChosenSwitch ChooseSwitch(int from, int to, const VectorXd& at, const Attachment* goal) {
    SwitchSide a = {&graph_.sets()[from], &cells_.of(from), std::nullopt};
    SwitchSide b = {&graph_.sets()[to], &cells_.of(to), std::nullopt};
    const GraspScore score = [&](const GraspSet& set, const VectorXd& parameters) {
      return Score(GraspAt(set, parameters));
    };
    auto [known, is_new] = best_switches_.try_emplace({from, to});
    if (is_new) {
      known->second = BestOf(FindSwitchPoints(a, b, kPolygonFingers), a, b, score);
      if (known->second) known->second = ImproveSwitch(a, b, *known->second, score);
    }
    const std::optional<SwitchPoint>& best = known->second;
    if (!best) return {};
    const double best_score = ScoreOf(a, b, *best, score);
    for (const auto& [fix_from, fix_to] : {std::pair(true, true), {true, false}, {false, true}}) {
      if (fix_to && goal == nullptr) continue;
      a.fixed = fix_from ? std::optional(at) : std::nullopt;
      b.fixed = fix_to ? std::optional(goal->parameters) : std::nullopt;
      auto point = BestOf(FindSwitchPoints(a, b, kPolygonFingers), a, b, score);
      if (point && ScoreOf(a, b, *point, score) >= std::max(kGoodShare * best_score, 0.0)) {
        return {std::move(point), true};
      }
    }
    return {best, best_score >= 0};
  }

  /// Of the switches with at least half of the best score, the one that keeps the most contacts.
  static std::optional<SwitchPoint> BestOf(std::vector<SwitchPoint> points, const SwitchSide& from,
                                           const SwitchSide& to, const GraspScore& score) {
    std::vector<double> scores;
    for (const SwitchPoint& point : points) scores.push_back(ScoreOf(from, to, point, score));
    std::optional<std::size_t> best;
    const double highest = scores.empty() ? 0 : *std::max_element(scores.begin(), scores.end());
    const double least = highest > 0 ? kGoodShare * highest : highest;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (scores[i] < least) continue;
      const auto rank = [&](std::size_t k) { return std::pair(points[k].kept.size(), scores[k]); };
      if (!best || rank(i) > rank(*best)) best = i;
    }
    if (!best) return std::nullopt;
    return std::move(points[*best]);
  }

  /// How good it is to rest in a grasp: its margin to the required half-angle where its quality is
  /// what is asked for, otherwise a negative number, the worse the lower the quality.
  [[nodiscard]] double Score(const Grasp& grasp) const {
    if (!IsForceClosure(grasp, frame_, options_.half_angle)) return -1;
    if (!QualityAtLeast(grasp, frame_, options_.half_angle, options_.min_quality)) {
      return ComputeQuality(grasp, frame_, options_.half_angle).lower / options_.min_quality - 1;
    }
    const auto required = ComputeRequiredHalfAngle(grasp, frame_, kScoreAccuracy);
    return required ? std::max(options_.half_angle - required->upper, 0.0) : 0;
  }

  [[nodiscard]] static Grasp ContactsOf(const Grasp& grasp, const Attachment& attachment) {
    Grasp contacts;
    for (const int contact : attachment.contacts) contacts.push_back(grasp[contact]);
    return contacts;
  }

  /// The contacts of a set at given parameters; those of start and goal as they were given.
  [[nodiscard]] Grasp GraspAt(const GraspSet& set, const VectorXd& parameters) const {
    Grasp grasp;
    for (const int edge : set.edges) {
      const double u = parameters[static_cast<Eigen::Index>(grasp.size())];
      Contact contact = ContactAt(polygon_, edge, u);
      for (const Grasp* given : {&start_.grasp, &goal_.grasp}) {
        for (const Contact& other : *given) {
          if (other.face == edge && ParameterOf(polygon_, other) == u) contact = other;
        }
      }
      grasp.push_back(contact);
    }
    return grasp;
  }

  void Begin(Draft& draft) const {
    for (const Contact& contact : start_.grasp) {
      draft.initial.push_back({static_cast<int>(draft.initial.size()), contact});
    }
    draft.rests = {start_.grasp};
    holding_ = draft.initial;
  }

  /// No step where the contacts are those that hold already.
  void SwitchTo(Draft& draft, const Grasp& after) const {
    Switch step = MakeSwitch(holding_, after, kPolygonFingers);
    if (step.place.empty() && step.release.empty()) return;
    AddStep(draft, std::move(step));
  }

  void AddStep(Draft& draft, Step step) const {
    holding_ = GraspAfter(holding_, step);
    draft.rests.push_back(regrasp::ContactsOf(holding_));
    draft.steps.push_back(std::move(step));
  }

  /// @returns false where no way is found inside the set.
  bool AlignTo(Draft& draft, int vertex, const VectorXd& from, const VectorXd& to) {
    if (from == to) return true;
    const std::vector<VectorXd> path = FindAlignPath(cells_.of(vertex), from, to);
    if (path.empty()) return false;
    Align align;
    for (const VectorXd& parameters : path) {
      const Grasp contacts = GraspAt(graph_.sets()[vertex], parameters);
      FingerGrasp waypoint = holding_;
      for (FingerContact& finger : waypoint) {
        finger.contact = *std::find_if(contacts.begin(), contacts.end(), [&](const Contact& c) {
          return c.face == finger.contact.face;
        });
      }
      align.waypoints.push_back(std::move(waypoint));
    }
    align.waypoints.front() = holding_;
    AddStep(draft, std::move(align));
    return true;
  }

  // The answer.

  void Finish(const Draft& draft, PlanResult& result) const {
    Plan plan;
    plan.dimension = polygon_.dimension();
    plan.half_angle = options_.half_angle;
    plan.fingers = kPolygonFingers;
    plan.planner = "polygon";
    plan.initial = draft.initial;
    plan.steps = draft.steps;
    plan.goal = goal_.grasp;
    result.plan = std::move(plan);
    result.margin = options_.half_angle;
    double weakest = options_.min_quality;
    std::size_t weakest_step = 0;
    for (std::size_t i = 0; i < draft.rests.size(); ++i) {
      const auto required = ComputeRequiredHalfAngle(draft.rests[i], frame_);
      if (required) {
        result.margin = std::min(result.margin, options_.half_angle - required->upper);
      }
      if (IsGood(draft.rests[i])) continue;
      const double quality = ComputeQuality(draft.rests[i], frame_, options_.half_angle).lower;
      if (quality >= weakest) continue;
      weakest = quality;
      weakest_step = i;
    }
    if (weakest >= options_.min_quality) return;
    const std::string where = weakest_step == 0
                                  ? "the start grasp (step 0)"
                                  : "the grasp after step " + std::to_string(weakest_step) +
                                        " of " + std::to_string(draft.steps.size());
    result.warnings = {"the sequence passes grasps below the quality " +
                       FormatShort(options_.min_quality) + " that was asked for; the weakest is " +
                       where + " with " + FormatShort(weakest)};
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
  WrenchFrame frame_;
  GraspChoice start_;
  GraspChoice goal_;
  PolygonGraph graph_;
  GraphCells cells_;
  std::vector<Attachment> start_at_;
  std::vector<Attachment> goal_at_;
  std::map<VertexPair, std::optional<SwitchPoint>> best_switches_;
  mutable FingerGrasp holding_;
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
