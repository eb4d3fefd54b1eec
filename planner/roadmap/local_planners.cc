#include "planner/roadmap/local_planners.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>
#include <span>

#include "planner/roadmap/grasp_tree.h"

namespace regrasp::roadmap {

namespace {

Quadruple Sorted(Quadruple grasp) {
  std::sort(grasp.begin(), grasp.end());
  return grasp;
}

/// Return the representatives of clusters, in the order of the clusters.
Quadruple RepresentativesOf(const ContactClusters& clusters, const FourClusters& of) {
  Quadruple representatives;
  for (int i = 0; i < 4; ++i) representatives[i] = clusters.representative(of[i]);
  return representatives;
}

/// Set of contacts for each contact of a grasp.
using Sets = std::array<std::vector<int>, 4>;

bool ContainsContact(std::span<const int> contacts, int contact) {
  return std::find(contacts.begin(), contacts.end(), contact) != contacts.end();
}

/// Return whether a grasp has two different contacts, one of each set.
bool HasOneOfEach(const Quadruple& grasp, const std::vector<int>& a, const std::vector<int>& b) {
  for (const int one : grasp) {
    if (!ContainsContact(a, one)) continue;
    for (const int other : grasp) {
      if (other != one && ContainsContact(b, other)) return true;
    }
  }
  return false;
}

/// Return replacements that lead only to grasps with one contact of each set.
///
/// The sets are disjoint with one exception. A contact of the grasp that moves to another cluster
/// can be near the representative of its own cluster, and can then represent either set. In this
/// case the two sets become one list, and grasps with both contacts from one of the sets are
/// excluded.
/// @param sets  sets of contacts; outlive the result.
Replacements OneOfEach(const Sets& sets, const Quadruple& grasp, int contact_count) {
  Replacements replacements{{sets.begin(), sets.end()}, std::vector<int>(contact_count, 0), {}};
  for (int i = 0; i < 4; ++i) {
    for (int moved = 0; moved < 4; ++moved) {
      if (moved == i || !ContainsContact(sets[i], grasp[moved])) continue;
      std::vector<int>& both = replacements.lists[i];
      std::erase(both, grasp[moved]);
      both.insert(both.end(), sets[moved].begin(), sets[moved].end());
      replacements.lists[moved].clear();
      replacements.allows = [&one = sets[i], &other = sets[moved]](const Quadruple& reached) {
        return HasOneOfEach(reached, one, other);
      };
    }
  }
  for (int i = 0; i < 4; ++i) {
    for (const int contact : replacements.lists[i]) replacements.list_of[contact] = i;
  }
  return replacements;
}

}  // namespace

FourClusters ClustersOf(const ContactClusters& clusters, const Quadruple& grasp) {
  FourClusters of;
  for (int i = 0; i < 4; ++i) of[i] = clusters.cluster_of(grasp[i]);
  return of;
}

std::optional<int> FindVertex(const Roadmap& roadmap, const FourClusters& clusters) {
  return roadmap.Find(Quadruple{clusters[0], clusters[1], clusters[2], clusters[3]});
}

const char* RoadmapLinkName(RoadmapLink link) {
  constexpr std::array kNames = {"none", "vertex", "algorithm-1", "algorithm-2", "algorithm-3"};
  return kNames[static_cast<int>(link)];
}

LocalPlanners::LocalPlanners(const ContactClusters& clusters, const Roadmap& roadmap,
                             GraspOracle& oracle)
    : clusters_(clusters), roadmap_(roadmap), oracle_(oracle) {
  assert(static_cast<int>(roadmap.points().size()) == clusters.cluster_count());
}

bool LocalPlanners::IsVertex(const Quadruple& grasp) {
  const FourClusters clusters = ClustersOf(clusters_, grasp);
  return RepresentativesOf(clusters_, clusters) == grasp &&
         FindVertex(roadmap_, clusters).has_value() && oracle_.Admits(grasp);
}

std::optional<Quadruple> LocalPlanners::OwnRepresentatives(const Quadruple& grasp) {
  const Quadruple representatives =
      Sorted(RepresentativesOf(clusters_, ClustersOf(clusters_, grasp)));
  if (!IsVertex(representatives)) return std::nullopt;
  return representatives;
}

std::optional<LocalPlanners::NearestCluster> LocalPlanners::FindNearestCluster(
    const Quadruple& grasp) {
  struct Candidate {
    double distance;
    NearestCluster nearest;
  };
  std::vector<Candidate> candidates;
  for (int slot = 0; slot < 4; ++slot) {
    FourClusters clusters = ClustersOf(clusters_, grasp);
    for (ClusterIndex cluster{0}; cluster < clusters_.cluster_count(); ++cluster) {
      if (cluster == clusters_.cluster_of(grasp[slot])) continue;
      clusters[slot] = cluster;
      if (!FindVertex(roadmap_, clusters)) continue;
      candidates.push_back({clusters_.DistanceToCenter(grasp[slot], cluster),
                            {Sorted(RepresentativesOf(clusters_, clusters)), slot, cluster}});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
  for (const Candidate& candidate : candidates) {
    if (oracle_.Admits(candidate.nearest.vertex)) return candidate.nearest;
  }
  return std::nullopt;
}

std::vector<int> LocalPlanners::Between(int contact, ClusterIndex cluster) const {
  const int representative = clusters_.representative(cluster);
  const double apart = clusters_.Distance(contact, representative);
  std::vector<int> between = {representative};
  if (contact != representative) between.push_back(contact);
  for (const int j : clusters_.members(cluster)) {
    if (j == contact || j == representative) continue;
    if (clusters_.Distance(contact, j) <= apart && clusters_.Distance(representative, j) <= apart) {
      between.push_back(j);
    }
  }
  return between;
}

std::vector<Quadruple> LocalPlanners::JoinWithin(const Quadruple& grasp,
                                                 const FourClusters& clusters,
                                                 const Quadruple& goal) {
  Sets sets;
  for (int i = 0; i < 4; ++i) sets[i] = Between(grasp[i], clusters[i]);
  const Replacements replacements =
      OneOfEach(sets, grasp, static_cast<int>(clusters_.contacts().size()));
  const auto distance = [&](int a, int b) { return clusters_.Distance(a, b); };
  return JoinGrasps(grasp, goal, replacements, distance, kMostLocalSteps, oracle_).path;
}

std::vector<Quadruple> LocalPlanners::RunAlgorithm1(const Quadruple& grasp) {
  const std::optional<Quadruple> goal = OwnRepresentatives(grasp);
  if (!goal) return {};
  return JoinWithin(grasp, ClustersOf(clusters_, grasp), *goal);
}

std::vector<Quadruple> LocalPlanners::RunAlgorithm2(const Quadruple& grasp) {
  const std::optional<NearestCluster> nearest = FindNearestCluster(grasp);
  if (!nearest) return {};
  FourClusters clusters = ClustersOf(clusters_, grasp);
  clusters[nearest->slot] = nearest->cluster;
  return JoinWithin(grasp, clusters, nearest->vertex);
}

std::vector<Quadruple> LocalPlanners::RunAlgorithm3(const Quadruple& grasp) {
  std::vector<int> contacts = clusters_.representatives();
  std::vector<double> remoteness(clusters_.contacts().size(), 0);
  for (const int contact : grasp) {
    if (std::find(contacts.begin(), contacts.end(), contact) != contacts.end()) continue;
    contacts.push_back(contact);
    remoteness[contact] = 1;
  }
  const int count = static_cast<int>(clusters_.contacts().size());
  GraspTree tree(grasp, Replacements::AnyOf(std::move(contacts), count), std::move(remoteness),
                 oracle_);
  for (std::int64_t step = 0; step < kMostLocalSteps && !tree.exhausted(); ++step) {
    if (tree.Step() && IsVertex(tree.last())) return tree.PathTo(tree.last());
  }
  return {};
}

LocalPlanners::Path LocalPlanners::Link(const Quadruple& grasp) {
  if (IsVertex(grasp)) return {RoadmapLink::kVertex, {grasp}};
  std::vector<Quadruple> path = RunAlgorithm1(grasp);
  if (!path.empty()) return {RoadmapLink::kAlgorithm1, std::move(path)};
  path = RunAlgorithm2(grasp);
  if (!path.empty()) return {RoadmapLink::kAlgorithm2, std::move(path)};
  path = RunAlgorithm3(grasp);
  if (!path.empty()) return {RoadmapLink::kAlgorithm3, std::move(path)};
  return {};
}

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
