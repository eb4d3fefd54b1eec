#include "planner/roadmap/plan_clustered.h"

#include <algorithm>
#include <set>

#include "planner/base/number.h"
#include "planner/planning/plan_search.h"
#include "planner/roadmap/contact_chain.h"
#include "planner/roadmap/find_contact.h"
#include "planner/sampling/draw_grasp.h"

namespace regrasp {

namespace {

constexpr int kContacts = 4;

/// Representatives that may shorten a chain, beside its own contacts: enough that one or two
/// switches are saved, few enough that all their grasps are tested in some milliseconds.
constexpr int kMoreContacts = 20;

using Kind = GraspChoice::Kind;
using Status = PlanResult::Status;

/// The plans of one clustered roadmap.
class ClusterPlanner {
 public:
  ClusterPlanner(const Polyhedron& solid, const RoadmapOptions& options)
      : solid_(solid),
        options_(options),
        evaluator_(solid, {options.half_angle, options.min_quality},
                   {.fingertip_radius = options.finger_radius}),
        roadmap_(BuildClusteredRoadmap(solid, options)) {}

  RoadmapPlanResult Plan(const GraspChoice& start, const GraspChoice& goal) {
    RandomStream start_numbers(options_.seed, RandomUse::kStart);
    RandomStream goal_numbers(options_.seed, RandomUse::kGoal);
    const GraspChoice from = Fix(start, start_numbers);
    if (goal.kind != Kind::kRandom) return PlanBetween(from, Fix(goal, goal_numbers));
    RoadmapPlanResult result;
    static_cast<PlanResult&>(result) = PlanToRandomGoal(
        [&](bool) -> PlanResult { return PlanBetween(from, Fix(goal, goal_numbers)); });
    return WithSizes(std::move(result));
  }

 private:
  GraspChoice Fix(GraspChoice choice, RandomStream& random) const {
    if (choice.kind == Kind::kGiven) {
      CheckGivenGrasp(choice, {"roadmap", kContacts, kContacts}, roadmap_.frame,
                      options_.half_angle, SamePoint());
      CheckFingersFit(choice, solid_, options_.finger_radius);
    } else {
      choice.grasp = choice.kind == Kind::kRandom
                         ? DrawContacts(choice, random)
                         : DrawOnSurface(solid_, {kContacts, kContacts}, evaluator_, random,
                                         choice.name, [&] { options_.deadline.Check(); });
      choice.kind = Kind::kGiven;
    }
    return choice;
  }

  Grasp DrawContacts(const GraspChoice& choice, RandomStream& random) const {
    const std::vector<Contact>& contacts = roadmap_.clusters.contacts();
    const auto grasp = DrawGoodGrasp(
        [&] {
          Grasp drawn;
          for (int i = 0; i < kContacts; ++i)
            drawn.push_back(contacts[random.Index(contacts.size())]);
          return drawn;
        },
        evaluator_);
    if (grasp) return *grasp;
    throw NoGrasp{choice.name + ": none of " + std::to_string(kMaxSurfaceDraws) +
                  " grasps drawn from " + std::to_string(contacts.size()) +
                  " contact points is force closure with a quality of at least " +
                  FormatShort(options_.min_quality)};
  }

  RoadmapPlanResult PlanBetween(const GraspChoice& start, const GraspChoice& goal) {
    options_.progress("linking start and goal to " +
                      std::to_string(roadmap_.roadmap.vertex_count()) +
                      " grasps of representatives");
    ContactClusters clusters = roadmap_.clusters;
    const Quadruple from = Join(start.grasp, clusters);
    const Quadruple to = Join(goal.grasp, clusters);
    GraspOracle oracle(clusters.contacts(), roadmap_.frame, SamePoint(),
                       {options_.half_angle, options_.min_quality},
                       {.fingertip_radius = options_.finger_radius}, options_.deadline);
    const auto find = [&] {
      return FindContactChain(roadmap_, clusters, oracle, from, to, options_.last_resort);
    };
    ContactChain chain = find();
    if (chain.grasps.empty()) {
      oracle.SetMinQuality(0);
      chain = find();
    }
    if (chain.grasps.empty()) return WithSizes(NoSequence(chain));
    std::set<int> used;
    for (const Quadruple& grasp : chain.grasps) used.insert(grasp.begin(), grasp.end());
    const std::vector<int>& more = clusters.representatives();
    used.insert(more.begin(), more.begin() + std::min<int>(kMoreContacts, std::ssize(more)));
    std::vector<Contact> contacts;
    for (const int contact : used) contacts.push_back(clusters.contacts()[contact]);
    RoadmapPlanResult result = PlanOverContacts(solid_, contacts, start, goal, options_);
    if (result.plan) result.plan->roadmap = NoteOf(chain);
    return WithSizes(std::move(result));
  }

  /// The numbers of a grasp's contacts, which are added where they are new.
  Quadruple Join(const Grasp& grasp, ContactClusters& clusters) const {
    Quadruple numbers;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const auto known =
          FindContact(clusters.contacts(), grasp[i], kPointTolerance * solid_.diameter());
      numbers[i] = known ? *known : clusters.Add(grasp[i]);
    }
    std::sort(numbers.begin(), numbers.end());
    return numbers;
  }

  RoadmapNote NoteOf(const ContactChain& chain) const {
    RoadmapNote note{options_.contacts, options_.clusters, options_.seed, {}, {}};
    if (chain.by == ContactChain::By::kRoadmap) {
      note.start = RoadmapLinkName(chain.start_link);
      note.goal = RoadmapLinkName(chain.goal_link);
    } else {
      note.start = note.goal =
          chain.by == ContactChain::By::kSubsets ? "last-resort-subsets" : "last-resort";
    }
    return note;
  }

  RoadmapPlanResult NoSequence(const ContactChain& chain) const {
    RoadmapPlanResult result;
    result.status = Status::kNoSequence;
    const auto end = [](const char* name, RoadmapLink link) {
      return std::string(name) + (link == RoadmapLink::kNone
                                      ? " has no link to them"
                                      : std::string(" is linked by ") + RoadmapLinkName(link));
    };
    result.message = "no sequence of finger switches was found from start to goal over " +
                     std::to_string(roadmap_.clusters.clustered_count()) + " contact points in " +
                     std::to_string(roadmap_.clusters.cluster_count()) +
                     " clusters: " + std::to_string(roadmap_.roadmap.vertex_count()) +
                     " force-closure grasps of their representatives in " +
                     std::to_string(roadmap_.components.count()) + " components, " +
                     end("start", chain.start_link) + ", " + end("goal", chain.goal_link);
    if (!options_.last_resort) return result;
    const std::string sizes = std::to_string(chain.start_size) +
                              " grasps of all contact points from start and " +
                              std::to_string(chain.goal_size) + " from goal";
    result.message += chain.exhausted ? "; there is none: the last resort reached all of " + sizes +
                                            " that one side can come to"
                                      : "; the last resort gave up, having reached " + sizes;
    return result;
  }

  RoadmapPlanResult WithSizes(RoadmapPlanResult result) const {
    result.contact_points = static_cast<int>(roadmap_.clusters.contacts().size());
    result.vertices = roadmap_.roadmap.vertex_count();
    return result;
  }

  double SamePoint() const { return kSamePoint * solid_.diameter(); }

  const Polyhedron& solid_;
  const RoadmapOptions& options_;
  GraspEvaluator evaluator_;
  ClusteredRoadmap roadmap_;
};

}  // namespace

RoadmapPlanResult PlanOnClusters(const Polyhedron& solid, const GraspChoice& start,
                                 const GraspChoice& goal, const RoadmapOptions& options) {
  try {
    return ClusterPlanner(solid, options).Plan(start, goal);
  } catch (const NoGrasp& none) {
    return {ResultOf(none)};
  } catch (const TimeUp& time_up) {
    return {ResultOf(time_up, "roadmap")};
  }
}

}  // namespace regrasp
