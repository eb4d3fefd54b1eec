#include "planner/roadmap/contact_point_search.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/base/random.h"
#include "planner/planning/candidate_sequence.h"
#include "planner/roadmap/build_roadmap.h"
#include "planner/sampling/surface_sampler.h"
#include "planner/search/switching_graph.h"

namespace regrasp::roadmap {

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
