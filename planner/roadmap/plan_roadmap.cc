#include "planner/roadmap/plan_roadmap.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/criteria/reach.h"
#include "planner/grasp/quality.h"
#include "planner/planning/plan_search.h"
#include "planner/planning/switch_sequence.h"
#include "planner/roadmap/find_contact.h"
#include "planner/roadmap/plan_clustered.h"
#include "planner/roadmap/roadmap_memory.h"
#include "planner/roadmap/vertex_quality.h"
#include "planner/sampling/contact_points.h"
#include "planner/sampling/draw_grasp.h"
#include "planner/search/fewest_switches.h"
#include "planner/search/widest_path.h"

namespace regrasp {

namespace {

constexpr int kContacts = 4;

/// Vertices that a random draw looks at before it gives up; a second of quality tests.
constexpr int kMaxVertexDraws = 20'000;

/// Quality tests between two reports of progress, a tenth of a second or so.
constexpr int kProgressEvery = 100;

using Status = RoadmapPlanResult::Status;

double SamePoint(const Polyhedron& solid) { return kSamePoint * solid.diameter(); }

void CheckOptions(const RoadmapOptions& options) {
  const int most = options.clusters > 0 ? kMaxClusteredContacts : kMaxRoadmapContacts;
  if (options.contacts < 4 || options.contacts > most) {
    throw std::invalid_argument("the number of contact points is out of range");
  }
  if (!(options.min_quality >= 0)) throw std::invalid_argument("min_quality is negative");
}

void JoinContacts(std::vector<Contact>& points, const std::vector<Contact>& more,
                  double tolerance) {
  for (const Contact& contact : more) {
    if (!FindContact(points, contact, tolerance)) points.push_back(contact);
  }
}

std::vector<Contact> SpreadContacts(const Polyhedron& solid, const RoadmapOptions& options) {
  CheckOptions(options);
  options.progress("spreading " + std::to_string(options.contacts) + " contact points");
  std::vector<Contact> contacts = SpreadContactPoints(solid, options.contacts, options.seed);
  std::erase_if(contacts, [&](const Contact& contact) {
    return !CanReach(solid, contact, options.finger_radius);
  });
  return contacts;
}

Roadmap JoinedRoadmap(const Polyhedron& solid, const std::vector<Contact>& given,
                      const std::vector<Contact>& contacts, const RoadmapOptions& options) {
  const double tolerance = kPointTolerance * solid.diameter();
  std::vector<Contact> points;
  JoinContacts(points, given, tolerance);
  JoinContacts(points, contacts, tolerance);
  options.progress("testing the grasps of four of " + std::to_string(points.size()) +
                   " contact points");
  return Roadmap(std::move(points), solid.wrench_frame(), options.half_angle, SamePoint(solid),
                 options.finger_radius, options.deadline);
}

/// The planning of one sequence: what its stages share.
class RoadmapPlanner {
 public:
  RoadmapPlanner(const Polyhedron& solid, const std::vector<Contact>& contacts,
                 const GraspChoice& start, const GraspChoice& goal, const RoadmapOptions& options)
      : solid_(solid),
        options_(options),
        frame_(solid.wrench_frame()),
        start_(Fix(start, RandomUse::kStart)),
        goal_(Fix(goal, RandomUse::kGoal)),
        roadmap_(RoadmapOver(contacts)),
        quality_(roadmap_, frame_, {options.half_angle, options.min_quality}) {}

  RoadmapPlanResult Run() {
    const int start = ChooseVertex(start_, RandomUse::kStart, std::nullopt);
    const int goal = ChooseVertex(goal_, RandomUse::kGoal, start);
    ReportSearch();
    const std::vector<int> path = FindPath(start, goal);
    RoadmapPlanResult result;
    if (path.empty()) {
      result.status = Status::kNoSequence;
      result.message = NoSequenceMessage(start, goal);
    } else {
      result.plan = MakePlan(path);
      result.warnings = Warnings(path);
      result.margin = SmallestMargin(path);
    }
    result.contact_points = static_cast<int>(roadmap_.points().size());
    result.vertices = roadmap_.vertex_count();
    result.quality_tests = quality_.quality_count();
    result.margin_tests = quality_.margin_count();
    return result;
  }

 private:
  /// Settles every choice that does not depend on the roadmap.
  GraspChoice Fix(GraspChoice choice, RandomUse use) const {
    if (choice.kind == GraspChoice::Kind::kGiven) {
      CheckGivenGrasp(choice, {"roadmap", kContacts, kContacts}, frame_, options_.half_angle,
                      SamePoint(solid_));
      CheckFingersFit(choice, solid_, options_.finger_radius);
    }
    if (choice.kind != GraspChoice::Kind::kRandomAny) return choice;
    RandomStream random(options_.seed, use);
    const GraspEvaluator evaluator(solid_, {options_.half_angle, options_.min_quality},
                                   {.fingertip_radius = options_.finger_radius});
    choice.grasp = DrawOnSurface(solid_, {kContacts, kContacts}, evaluator, random, choice.name,
                                 [&] { options_.deadline.Check(); });
    choice.kind = GraspChoice::Kind::kGiven;
    return choice;
  }

  Roadmap RoadmapOver(const std::vector<Contact>& contacts) const {
    std::vector<Contact> given = start_.grasp;
    given.insert(given.end(), goal_.grasp.begin(), goal_.grasp.end());
    return JoinedRoadmap(solid_, given, contacts, options_);
  }

  int ChooseVertex(GraspChoice& choice, RandomUse use, std::optional<int> start) {
    if (choice.kind == GraspChoice::Kind::kGiven) return VertexOf(choice);
    const int vertex = DrawVertex(choice, use, start);
    choice.grasp = roadmap_.grasp(vertex);
    return vertex;
  }

  int VertexOf(const GraspChoice& choice) const {
    std::vector<int> points;
    for (const Contact& contact : choice.grasp) {
      points.push_back(
          FindContact(roadmap_.points(), contact, kPointTolerance * solid_.diameter()).value());
    }
    const std::optional<int> vertex = roadmap_.Find(points);
    // Only where a contact was joined to another of the same place can the verdict have changed.
    if (!vertex) throw InputError(choice.name + ": too close to the limit of force closure");
    return *vertex;
  }

  /// A vertex of good quality by the seed, out of the start's component where there is a start and
  /// then another one than it, if the component has another.
  int DrawVertex(const GraspChoice& choice, RandomUse use, std::optional<int> start) {
    std::vector<int> pool = Pool(start);
    RandomStream random(options_.seed, use);
    const std::size_t draws = std::min<std::size_t>(pool.size(), kMaxVertexDraws);
    for (std::size_t i = 0; i < draws; ++i) {
      std::swap(pool[i], pool[i + random.Index(pool.size() - i)]);
      options_.deadline.Check();
      if (quality_.IsGood(pool[i])) return pool[i];
    }
    throw NoGrasp{choice.name + ": none of " + std::to_string(draws) + " grasps drawn from the " +
                  (start ? "start's component of the roadmap" : "roadmap") +
                  " has a quality of at least " + FormatShort(options_.min_quality)};
  }

  std::vector<int> Pool(std::optional<int> start) const {
    std::vector<int> pool(roadmap_.vertex_count());
    std::iota(pool.begin(), pool.end(), 0);
    if (!start) return pool;
    const Components components = roadmap_.components();
    const int component = components.of_vertex[*start];
    if (components.sizes[component] == 1) return {*start};
    std::erase_if(pool, [&](int v) { return v == *start || components.of_vertex[v] != component; });
    return pool;
  }

  std::vector<int> FindPath(int start, int goal) {
    const VertexFilter good = [&](int vertex) {
      options_.deadline.Check();
      const bool is_good = quality_.IsGood(vertex);
      if (quality_.quality_count() % kProgressEvery == 0) ReportSearch();
      return is_good;
    };
    const VertexFilter any = [&](int) {
      options_.deadline.Check();
      return true;
    };
    const std::vector<int> path = FindPath(start, goal, good);
    return path.empty() ? FindPath(start, goal, any) : path;
  }

  void ReportSearch() const {
    options_.progress("searching a sequence among " + std::to_string(roadmap_.vertex_count()) +
                      " grasps, quality of " + std::to_string(quality_.quality_count()) +
                      " tested");
  }

  std::vector<int> FindPath(int start, int goal, const VertexFilter& admits) {
    const std::optional<int> switches = FewestSwitches(roadmap_, start, goal, admits);
    if (!switches) return {};
    return WidestPath(roadmap_, start, goal, *switches, admits,
                      [&](int vertex) { return quality_.Margin(vertex); });
  }

  std::string NoSequenceMessage(int start, int goal) const {
    const auto all = [](int) { return true; };
    const auto size = [&](int vertex) {
      return std::to_string(ReachableVertices(roadmap_, vertex, all).size());
    };
    return "no sequence of finger switches leads from start to goal over these contact points: "
           "searched " +
           std::to_string(roadmap_.points().size()) + " contact points, " +
           std::to_string(roadmap_.candidate_count()) + " subsets of four, " +
           std::to_string(roadmap_.vertex_count()) +
           " force-closure grasps; the start's component has " + size(start) +
           " of them, the goal's " + size(goal);
  }

  Plan MakePlan(const std::vector<int>& path) const {
    std::vector<Grasp> grasps;
    for (const int vertex : path) grasps.push_back(roadmap_.grasp(vertex));
    // The fingers of the first grasp follow the order in which it was given.
    grasps.front() = start_.grasp;
    Sequence sequence = MakeSwitchSequence(grasps, kRoadmapFingers);
    Plan plan;
    plan.dimension = solid_.dimension();
    plan.half_angle = options_.half_angle;
    plan.fingers = kRoadmapFingers;
    plan.planner = "roadmap";
    if (options_.finger_radius > 0) plan.finger_radius = options_.finger_radius;
    plan.initial = std::move(sequence.initial);
    plan.steps = std::move(sequence.steps);
    plan.goal = goal_.grasp;
    return plan;
  }

  double SmallestMargin(const std::vector<int>& path) {
    double smallest = options_.half_angle;
    for (const int vertex : path) smallest = std::min(smallest, quality_.Margin(vertex));
    return smallest;
  }

  std::vector<std::string> Warnings(const std::vector<int>& path) {
    if (std::all_of(path.begin(), path.end(), [&](int v) { return quality_.IsGood(v); })) return {};
    double weakest = options_.min_quality;
    std::size_t step = 0;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const double quality =
          ComputeQuality(roadmap_.grasp(path[i]), frame_, options_.half_angle).lower;
      if (quality >= weakest) continue;
      weakest = quality;
      step = i;
    }
    const std::string where = step == 0 ? "the start grasp (step 0)"
                                        : "the grasp after step " + std::to_string(step) + " of " +
                                              std::to_string(path.size() - 1);
    return {"the sequence passes grasps below the quality " + FormatShort(options_.min_quality) +
            " that was asked for; the weakest is " + where + " with " + FormatShort(weakest)};
  }

  const Polyhedron& solid_;
  const RoadmapOptions& options_;
  WrenchFrame frame_;
  GraspChoice start_;
  GraspChoice goal_;
  Roadmap roadmap_;
  VertexQuality quality_;
};

}  // namespace

RoadmapSize ChooseRoadmapSize(const Polyhedron& solid, std::optional<int> contacts,
                              std::optional<int> clusters) {
  constexpr int kClusteredContacts = 1000;
  constexpr int kClusters = 50;
  const bool many = contacts.value_or(solid.face_count()) > kMaxRoadmapContacts;
  const int chosen = clusters.value_or(many ? kClusters : 0);
  return {contacts.value_or(chosen > 0 ? kClusteredContacts : RoadmapOptions().contacts), chosen};
}

Roadmap BuildRoadmap(const Polyhedron& solid, const RoadmapOptions& options,
                     const std::vector<Contact>& joined) {
  return JoinedRoadmap(solid, joined, SpreadContacts(solid, options), options);
}

ClusteredRoadmap BuildClusteredRoadmap(const Polyhedron& solid, const RoadmapOptions& options) {
  CheckOptions(options);
  return ClusteredRoadmap(solid,
                          {options.half_angle, options.contacts, options.clusters, options.seed,
                           options.progress, options.finger_radius, options.deadline});
}

RoadmapPlanResult PlanOverContacts(const Polyhedron& solid, const std::vector<Contact>& contacts,
                                   const GraspChoice& start, const GraspChoice& goal,
                                   const RoadmapOptions& options) {
  try {
    return RoadmapPlanner(solid, contacts, start, goal, options).Run();
  } catch (const NoGrasp& none) {
    return {ResultOf(none)};
  } catch (const TimeUp& time_up) {
    return {ResultOf(time_up, "roadmap")};
  }
}

RoadmapPlanResult PlanOnRoadmap(const Polyhedron& solid, const GraspChoice& start,
                                const GraspChoice& goal, const RoadmapOptions& options) {
  CheckOptions(options);
  try {
    CheckMemory([&] { return EstimateRoadmap(solid, options); }, options.memory);
  } catch (const NoGrasp& none) {
    return {ResultOf(none)};
  }
  if (options.clusters > 0) return PlanOnClusters(solid, start, goal, options);
  return PlanOverContacts(solid, SpreadContacts(solid, options), start, goal, options);
}

}  // namespace regrasp
