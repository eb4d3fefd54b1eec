#include "planner/roadmap/cluster_search.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/planning/candidate_sequence.h"
#include "planner/roadmap/clustered_roadmap.h"
#include "planner/roadmap/local_planners.h"
#include "planner/sampling/surface_sampler.h"
#include "planner/search/switching_graph.h"

namespace regrasp::roadmap {

namespace {

/// Number of representatives that may shorten a chain, in addition to its own contacts. They are
/// enough to save one or two switches, and few enough to test all their grasps in milliseconds.
constexpr int kMoreContacts = 20;

using Kind = planning::GraspChoice::Kind;
using Status = planning::PlanResult::Status;

/// Planner on one clustered roadmap.
class ClusterSearch {
 public:
  explicit ClusterSearch(const planning::PlanRequest& request)
      : request_(request),
        last_resort_(request.parameters.Get<RoadmapParameters>().last_resort),
        evaluator_(*request.object, request.criteria, request.hand),
        roadmap_(BuildClusteredRoadmap(request)) {}

  planning::PlanResult Plan() {
    RandomStream start_numbers(request_.seed, RandomUse::kStart);
    RandomStream goal_numbers(request_.seed, RandomUse::kGoal);
    const planning::GraspChoice start = Resolve(request_.start, start_numbers);
    const auto plan = [&] { return PlanBetween(start, Resolve(request_.goal, goal_numbers)); };
    if (request_.goal.kind != Kind::kRandom) return plan();
    return planning::PlanToRandomGoal([&](bool /*last*/) { return plan(); });
  }

 private:
  [[nodiscard]] planning::GraspChoice Resolve(const planning::GraspChoice& choice,
                                              RandomStream& random) const {
    if (choice.kind == Kind::kGiven) return choice;
    return {Kind::kGiven, DrawContacts(choice, random), choice.name};
  }

  grasp::Grasp DrawContacts(const planning::GraspChoice& choice, RandomStream& random) const {
    const std::vector<grasp::Contact>& contacts = roadmap_.clusters.contacts();
    const auto grasp = sampling::DrawGoodGrasp(
        [&] {
          grasp::Grasp drawn;
          for (int i = 0; i < kRoadmapContacts; ++i)
            drawn.push_back(contacts[random.Index(contacts.size())]);
          return drawn;
        },
        evaluator_);
    if (grasp) return *grasp;
    throw sampling::NoGrasp{choice.name + ": none of " +
                            std::to_string(sampling::kMaxSurfaceDraws) + " grasps drawn from " +
                            std::to_string(contacts.size()) + " contact points is force closure" +
                            criteria::WithWhatIsAsked(request_.criteria)};
  }

  planning::PlanResult PlanBetween(const planning::GraspChoice& start,
                                   const planning::GraspChoice& goal) {
    request_.progress("linking start and goal to " +
                      std::to_string(roadmap_.roadmap.vertex_count()) +
                      " grasps of representatives");
    ContactClusters clusters = roadmap_.clusters;
    const Quadruple from = Join(start.grasp, clusters);
    const Quadruple to = Join(goal.grasp, clusters);
    GraspOracle oracle(*request_.object, clusters.contacts(), request_.criteria, request_.hand,
                       request_.deadline);
    const auto find = [&] {
      return FindContactChain(roadmap_, clusters, oracle, from, to, last_resort_);
    };
    ContactChain chain = find();
    if (chain.grasps.empty()) {
      oracle.SetShare(0);
      chain = find();
    }
    if (chain.grasps.empty()) return NoSequence(chain);
    std::set<int> used;
    for (const Quadruple& grasp : chain.grasps) used.insert(grasp.begin(), grasp.end());
    const std::vector<int>& more = clusters.representatives();
    used.insert(more.begin(), more.begin() + std::min<int>(kMoreContacts, std::ssize(more)));
    std::vector<grasp::Contact> contacts;
    for (const int contact : used) contacts.push_back(clusters.contacts()[contact]);
    planning::PlanRequest between = request_;
    between.start = start;
    between.goal = goal;
    planning::PlanResult result = SearchContactPoints(contacts, between);
    if (result.plan) result.plan->roadmap = NoteOf(chain);
    return result;
  }

  /// Return the numbers of a grasp's contacts. New contacts are added.
  Quadruple Join(const grasp::Grasp& grasp, ContactClusters& clusters) const {
    Quadruple numbers;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const auto known = FindContact(clusters.contacts(), grasp[i],
                                     object::kPointTolerance * request_.object->diameter());
      numbers[i] = known ? *known : clusters.Add(grasp[i]);
    }
    std::sort(numbers.begin(), numbers.end());
    return numbers;
  }

  plan::RoadmapNote NoteOf(const ContactChain& chain) const {
    const RoadmapSize size = SizeOf(request_);
    plan::RoadmapNote note{size.contacts, size.clusters, request_.seed, {}, {}};
    if (chain.by == ContactChain::By::kRoadmap) {
      note.start = RoadmapLinkName(chain.start_link);
      note.goal = RoadmapLinkName(chain.goal_link);
    } else {
      note.start = note.goal =
          chain.by == ContactChain::By::kSubsets ? "last-resort-subsets" : "last-resort";
    }
    return note;
  }

  planning::PlanResult NoSequence(const ContactChain& chain) const {
    planning::PlanResult result;
    result.status = Status::kNoSequence;
    const auto end = [](const char* name, RoadmapLink link) {
      return std::string(name) + (link == RoadmapLink::kNone
                                      ? " has no link to them"
                                      : std::string(" is linked by ") + RoadmapLinkName(link));
    };
    result.message = "planner roadmap finds no path over " +
                     std::to_string(roadmap_.clusters.clustered_count()) + " contact points in " +
                     std::to_string(roadmap_.clusters.cluster_count()) +
                     " clusters: " + std::to_string(roadmap_.roadmap.vertex_count()) +
                     " force-closure grasps of their representatives in " +
                     std::to_string(roadmap_.components.count()) + " components, " +
                     end("start", chain.start_link) + ", " + end("goal", chain.goal_link);
    if (!last_resort_) return result;
    const std::string sizes = std::to_string(chain.start_size) +
                              " grasps of all contact points from start and " +
                              std::to_string(chain.goal_size) + " from goal";
    result.message +=
        chain.exhausted
            ? "; no sequence exists over these points: the fallback search reached all of " +
                  sizes + " that are reachable from one side"
            : "; the fallback search stopped after " + sizes;
    return result;
  }

  const planning::PlanRequest& request_;
  bool last_resort_;
  criteria::GraspEvaluator evaluator_;
  ClusteredRoadmap roadmap_;
};

}  // namespace

planning::PlanResult SearchClusters(const planning::PlanRequest& request) {
  return ClusterSearch(request).Plan();
}

namespace {

/// Largest number of vertices that a random draw evaluates; about a second of quality tests.
constexpr int kMaxVertexDraws = 20'000;

/// Number of quality tests between two progress messages; about a tenth of a second.
constexpr int kProgressEvery = 100;

/// Planner of one sequence.
class ContactPointSearch {
 public:
  ContactPointSearch(const std::vector<grasp::Contact>& contacts,
                     const planning::PlanRequest& request)
      : request_(request),
        start_(request.start),
        goal_(request.goal),
        roadmap_(RoadmapOver(contacts)),
        evaluator_(*request.object, request.criteria, request.hand),
        known_(roadmap_.vertex_count(),
               criteria::KnownGrasp::HeldAt(request.criteria.friction_angle)) {}

  planning::PlanResult Run() {
    const int start = ChooseVertex(start_, RandomUse::kStart, std::nullopt);
    const int goal = ChooseVertex(goal_, RandomUse::kGoal, start);
    ReportSearch();
    const std::vector<int> path = FindPath(start, goal);
    if (!path.empty()) return Finish(path);
    planning::PlanResult none;
    none.status = planning::PlanResult::Status::kNoSequence;
    none.message = NoSequenceMessage(start, goal);
    return none;
  }

 private:
  [[nodiscard]] Roadmap RoadmapOver(const std::vector<grasp::Contact>& contacts) const {
    std::vector<grasp::Contact> given = start_.grasp;
    given.insert(given.end(), goal_.grasp.begin(), goal_.grasp.end());
    return BuildRoadmap(request_, contacts, given);
  }

  int ChooseVertex(planning::GraspChoice& choice, RandomUse use, std::optional<int> start) {
    if (choice.kind == planning::GraspChoice::Kind::kGiven) return VertexOf(choice);
    const int vertex = DrawVertex(choice, use, start);
    choice.grasp = roadmap_.grasp(vertex);
    return vertex;
  }

  int VertexOf(const planning::GraspChoice& choice) const {
    std::vector<int> points;
    for (const grasp::Contact& contact : choice.grasp) {
      points.push_back(FindContact(roadmap_.points(), contact,
                                   object::kPointTolerance * request_.object->diameter())
                           .value());
    }
    const std::optional<int> vertex = roadmap_.Find(points);
    // The result of the test can differ only if a contact was merged with another one at the same
    // point.
    if (!vertex) throw InputError(choice.name + ": too close to the limit of force closure");
    return *vertex;
  }

  /// Draw a vertex of sufficient quality.
  /// If there is a start, the vertex is in its component, and different from it if the component
  /// has other vertices.
  int DrawVertex(const planning::GraspChoice& choice, RandomUse use, std::optional<int> start) {
    std::vector<int> pool = Pool(start);
    RandomStream random(request_.seed, use);
    const std::size_t draws = std::min<std::size_t>(pool.size(), kMaxVertexDraws);
    for (std::size_t i = 0; i < draws; ++i) {
      std::swap(pool[i], pool[i + random.Index(pool.size() - i)]);
      request_.deadline.Check();
      if (IsGood(pool[i])) return pool[i];
    }
    throw sampling::NoGrasp{choice.name + ": no grasp" +
                            criteria::WithWhatIsAsked(request_.criteria) + " is among " +
                            std::to_string(draws) + " drawn from the " +
                            (start ? "start's component of the roadmap" : "roadmap")};
  }

  std::vector<int> Pool(std::optional<int> start) const {
    std::vector<int> pool(roadmap_.vertex_count());
    std::iota(pool.begin(), pool.end(), 0);
    if (!start) return pool;
    const search::Components components = roadmap_.FindComponents(request_.deadline);
    const int component = components.of_vertex[*start];
    if (components.sizes[component] == 1) return {*start};
    std::erase_if(pool, [&](int v) { return v == *start || components.of_vertex[v] != component; });
    return pool;
  }

  bool IsGood(int vertex) {
    return evaluator_.Admits(known_[vertex], [&] { return roadmap_.grasp(vertex); });
  }

  /// Return the friction margin to kMarginTolerance, radians.
  double Margin(int vertex) {
    return request_.criteria.friction_angle -
           evaluator_.RequiredFrictionAngle(
               known_[vertex], [&] { return roadmap_.grasp(vertex); }, kMarginTolerance);
  }

  std::vector<int> FindPath(int start, int goal) {
    const search::VertexFilter good = [&](int vertex) {
      request_.deadline.Check();
      const bool is_good = IsGood(vertex);
      ReportSearchSometimes();
      return is_good;
    };
    const search::VertexFilter any = [&](int) {
      request_.deadline.Check();
      return true;
    };
    const std::vector<int> path = FindPath(start, goal, good);
    return path.empty() ? FindPath(start, goal, any) : path;
  }

  void ReportSearchSometimes() {
    if (evaluator_.counts().criteria < next_report_) return;
    next_report_ = evaluator_.counts().criteria + kProgressEvery;
    ReportSearch();
  }

  void ReportSearch() const {
    request_.progress("searching a sequence among " + std::to_string(roadmap_.vertex_count()) +
                      " grasps, quality of " + std::to_string(evaluator_.counts().criteria) +
                      " tested");
  }

  std::vector<int> FindPath(int start, int goal, const search::VertexFilter& admits) {
    const std::optional<int> switches = search::FewestSwitches(roadmap_, start, goal, admits);
    if (!switches) return {};
    return search::WidestPath(roadmap_, start, goal, *switches, admits,
                              [&](int vertex) { return Margin(vertex); });
  }

  std::string NoSequenceMessage(int start, int goal) const {
    const auto all = [](int) { return true; };
    const auto size = [&](int vertex) {
      return std::to_string(search::ReachableVertices(roadmap_, vertex, all).size());
    };
    return "planner roadmap: no sequence over these contact points connects start and goal; "
           "searched " +
           std::to_string(roadmap_.points().size()) + " contact points, " +
           std::to_string(roadmap_.candidate_count()) + " subsets of four, " +
           std::to_string(roadmap_.vertex_count()) +
           " force-closure grasps; the start's component has " + size(start) +
           " of them, the goal's " + size(goal);
  }

  [[nodiscard]] planning::PlanResult Finish(const std::vector<int>& path) const {
    std::vector<grasp::Grasp> grasps;
    for (const int vertex : path) grasps.push_back(roadmap_.grasp(vertex));
    // The finger order of the first grasp is that of the request.
    grasps.front() = start_.grasp;
    return planning::ResultOf(planning::MakeSwitchSequence(grasps, request_.hand.fingers),
                              evaluator_, "roadmap", request_, goal_.grasp);
  }

  const planning::PlanRequest& request_;
  planning::GraspChoice start_;
  planning::GraspChoice goal_;
  Roadmap roadmap_;
  criteria::GraspEvaluator evaluator_;
  KnownVertices known_;
  std::int64_t next_report_ = kProgressEvery;  ///< number of tests at the next message
};

}  // namespace

planning::PlanResult SearchContactPoints(const std::vector<grasp::Contact>& contacts,
                                         const planning::PlanRequest& request) {
  return ContactPointSearch(contacts, request).Run();
}

}  // namespace regrasp::roadmap
