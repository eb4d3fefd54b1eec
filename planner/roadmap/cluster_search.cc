#include "planner/roadmap/cluster_search.h"

#include <algorithm>
#include <set>
#include <utility>

#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/planning/candidate_sequence.h"
#include "planner/roadmap/build_roadmap.h"
#include "planner/roadmap/contact_chain.h"
#include "planner/roadmap/contact_point_search.h"
#include "planner/sampling/surface_sampler.h"

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
    result.message = "planner roadmap connects no path over " +
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
                  sizes + " that one side can reach"
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

}  // namespace regrasp::roadmap
