#include "planner/roadmap/contact_chain.h"

#include <algorithm>
#include <numeric>

#include "planner/roadmap/grasp_tree.h"

namespace regrasp::roadmap {

namespace {

/// Query with its data and stages.
class ChainSearch {
 public:
  ChainSearch(const ClusteredRoadmap& roadmap, const ContactClusters& clusters, GraspOracle& oracle)
      : roadmap_(roadmap), clusters_(clusters), oracle_(oracle) {}

  ContactChain ByRoadmap(const Quadruple& start, const Quadruple& goal) {
    LocalPlanners local(clusters_, roadmap_.roadmap, oracle_);
    ContactChain chain;
    const LocalPlanners::Path from = LinkOrAdd(start, local);
    const LocalPlanners::Path to = LinkOrAdd(goal, local);
    chain.start_link = from.link;
    chain.goal_link = to.link;
    const std::vector<Quadruple> middle = JoinInRoadmap(from, to, start, goal);
    if (middle.empty()) return chain;
    chain.by = ContactChain::By::kRoadmap;
    // An end without a link was connected to the other end by its contacts among the
    // representatives.
    for (RoadmapLink* link : {&chain.start_link, &chain.goal_link}) {
      if (*link == RoadmapLink::kNone) *link = RoadmapLink::kAlgorithm3;
    }
    chain.grasps = from.grasps;
    chain.grasps.insert(chain.grasps.end(), middle.begin() + 1, middle.end());
    chain.grasps.insert(chain.grasps.end(), to.grasps.rbegin() + 1, to.grasps.rend());
    return chain;
  }

  void ByLastResort(const Quadruple& start, const Quadruple& goal, ContactChain& chain) {
    const Junction direct = Join(start, goal, ContactsOf(start, goal), kMostLocalSteps);
    chain.grasps = direct.path;
    chain.by = ContactChain::By::kSubsets;
    if (!chain.grasps.empty()) return;
    std::vector<int> all(clusters_.contacts().size());
    std::iota(all.begin(), all.end(), 0);
    const Junction found = Join(start, goal, std::move(all), kMostLastResortSteps);
    chain.grasps = found.path;
    chain.by = found.path.empty() ? ContactChain::By::kNothing : ContactChain::By::kLastResort;
    chain.exhausted = found.exhausted;
    chain.start_size = found.from_size;
    chain.goal_size = found.to_size;
  }

 private:
  /// Return the path of an end to the roadmap.
  /// Algorithm 3 adds an end to the roadmap even if no path connects it to an existing vertex,
  /// because it can be connected to the other end, which is added as well.
  static LocalPlanners::Path LinkOrAdd(const Quadruple& end, LocalPlanners& local) {
    LocalPlanners::Path path = local.Link(end);
    if (path.grasps.empty()) path.grasps = {end};
    return path;
  }

  static bool IsAdded(const LocalPlanners::Path& path) {
    return path.link == RoadmapLink::kAlgorithm3 || path.link == RoadmapLink::kNone;
  }

  static std::vector<int> ContactsOf(const Quadruple& start, const Quadruple& goal) {
    std::vector<int> contacts(start.begin(), start.end());
    for (const int contact : goal) {
      if (std::find(start.begin(), start.end(), contact) == start.end()) {
        contacts.push_back(contact);
      }
    }
    return contacts;
  }

  Junction Join(const Quadruple& from, const Quadruple& to, std::vector<int> contacts,
                std::int64_t most_steps) {
    const auto distance = [&](int a, int b) { return clusters_.Distance(a, b); };
    const int count = static_cast<int>(clusters_.contacts().size());
    return JoinGrasps(from, to, Replacements::AnyOf(std::move(contacts), count), distance,
                      most_steps, oracle_);
  }

  int ComponentOf(const Quadruple& vertex) const {
    const FourClusters clusters = ClustersOf(clusters_, vertex);
    return roadmap_.components.of_vertex[*FindVertex(roadmap_.roadmap, clusters)];
  }

  std::vector<Quadruple> JoinInRoadmap(const LocalPlanners::Path& from,
                                       const LocalPlanners::Path& to, const Quadruple& start,
                                       const Quadruple& goal) {
    std::vector<int> contacts = clusters_.representatives();
    const auto take = [&](const Quadruple& grasp) {
      for (const int contact : grasp) {
        if (std::find(contacts.begin(), contacts.end(), contact) == contacts.end()) {
          contacts.push_back(contact);
        }
      }
    };
    if (IsAdded(from)) take(start);
    if (IsAdded(to)) take(goal);
    const Quadruple& a = from.grasps.back();
    const Quadruple& b = to.grasps.back();
    if (!IsAdded(from) && !IsAdded(to) && ComponentOf(a) != ComponentOf(b)) return {};
    return Join(a, b, std::move(contacts), kMostLocalSteps).path;
  }

  const ClusteredRoadmap& roadmap_;
  const ContactClusters& clusters_;
  GraspOracle& oracle_;
};

}  // namespace

ContactChain FindContactChain(const ClusteredRoadmap& roadmap, const ContactClusters& clusters,
                              GraspOracle& oracle, const Quadruple& start, const Quadruple& goal,
                              bool last_resort) {
  ChainSearch search(roadmap, clusters, oracle);
  ContactChain chain = search.ByRoadmap(start, goal);
  if (chain.grasps.empty() && last_resort) search.ByLastResort(start, goal, chain);
  return chain;
}

}  // namespace regrasp::roadmap
