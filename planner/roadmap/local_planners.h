#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "planner/roadmap/clustered_roadmap.h"
#include "planner/roadmap/contact_clusters.h"
#include "planner/roadmap/grasp_tree.h"
#include "planner/roadmap/roadmap.h"

namespace regrasp::roadmap {

/// Clusters of the contacts of a grasp. The points of a representative roadmap have the numbers of
/// their clusters, so its vertices are found by clusters instead of contacts.
using FourClusters = std::array<ClusterIndex, 4>;
[[nodiscard]] FourClusters ClustersOf(const ContactClusters& clusters, const Quadruple& grasp);

/// Return the vertex of the representatives of four clusters.
[[nodiscard]] std::optional<int> FindVertex(const Roadmap& roadmap, const FourClusters& clusters);

/// Method by which a grasp is linked to the representative roadmap.
enum class RoadmapLink {
  kNone,        ///< no link found
  kVertex,      ///< the grasp is a vertex
  kAlgorithm1,  ///< link to the representatives of its own clusters
  kAlgorithm2,  ///< link to a grasp that differs from that in one cluster
  kAlgorithm3,  ///< link with its own contacts added to the representatives
};

/// Return the name of a link in plans: "vertex", "algorithm-1", …
[[nodiscard]] const char* RoadmapLinkName(RoadmapLink link);

/// Local planners from a grasp of any contact points to the representative roadmap.
/// They are algorithms 1, 2 and 3 of Phoka 2010, 6.2.4.
/// They evaluate a grasp only when they reach it.
class LocalPlanners {
 public:
  /// @param clusters  clusters with all contacts of the grasps. All arguments outlive this object.
  /// @param roadmap   roadmap of the representatives, in cluster order.
  /// @param oracle    evaluator of the contacts of `clusters`.
  LocalPlanners(const ContactClusters& clusters, const Roadmap& roadmap, GraspOracle& oracle);

  /// Path from a grasp to a vertex of the roadmap, both included; empty if none is found.
  struct Path {
    RoadmapLink link = RoadmapLink::kNone;
    std::vector<Quadruple> grasps;
  };
  /// Link a grasp by the first algorithm that finds a path. A grasp that is a vertex requires none.
  [[nodiscard]] Path Link(const Quadruple& grasp);

  /// Return the target of algorithm 1 or 2; nullopt if there is no admitted vertex.
  /// Algorithm 1 aims at the representatives of the grasp's clusters. Algorithm 2 aims at a vertex
  /// that differs from them in one cluster: the cluster whose centre is nearest to the contact that
  /// moves to it.
  [[nodiscard]] std::optional<Quadruple> OwnRepresentatives(const Quadruple& grasp);
  struct NearestCluster {
    Quadruple vertex;      ///< contacts of the vertex
    int slot = 0;          ///< index of the grasp's contact that moves
    ClusterIndex cluster;  ///< cluster to which it moves
  };
  [[nodiscard]] std::optional<NearestCluster> FindNearestCluster(const Quadruple& grasp);

  /// Run single algorithms; empty if an algorithm does not apply or finds no path.
  [[nodiscard]] std::vector<Quadruple> RunAlgorithm1(const Quadruple& grasp);
  [[nodiscard]] std::vector<Quadruple> RunAlgorithm2(const Quadruple& grasp);
  [[nodiscard]] std::vector<Quadruple> RunAlgorithm3(const Quadruple& grasp);

 private:
  /// Return whether a grasp, given by its contacts, is a vertex of the roadmap.
  [[nodiscard]] bool IsVertex(const Quadruple& grasp);
  /// Return the set S_i: `contact`, the representative of `cluster`, and the contacts near both.
  [[nodiscard]] std::vector<int> Between(int contact, ClusterIndex cluster) const;
  /// Find a path whose contacts are in the sets between each contact of the grasp and its cluster.
  [[nodiscard]] std::vector<Quadruple> JoinWithin(const Quadruple& grasp,
                                                  const FourClusters& clusters,
                                                  const Quadruple& goal);

  const ContactClusters& clusters_;
  const Roadmap& roadmap_;
  GraspOracle& oracle_;
};

/// Largest number of replacements that one search evaluates.
inline constexpr std::int64_t kMostLocalSteps = 2'000'000;

/// Result of a query on a clustered roadmap.
struct ContactChain {
  enum class By {
    kNothing,
    kRoadmap,     ///< both ends are linked to the roadmap and connected in it
    kSubsets,     ///< last resort: grasps of the contacts of both ends
    kLastResort,  ///< last resort: grasps of all contact points
  };
  By by = By::kNothing;
  std::vector<Quadruple> grasps;  ///< path from start to goal, inclusive; empty if none
  RoadmapLink start_link = RoadmapLink::kNone;
  RoadmapLink goal_link = RoadmapLink::kNone;
  /// Whether a failed last resort searched one side completely.
  /// Then no sequence exists over these contact points.
  /// The sizes are the numbers of grasps reached from both sides.
  bool exhausted = false;
  std::size_t start_size = 0;
  std::size_t goal_size = 0;
};

/// Find a chain of grasps in which consecutive grasps differ in one contact.
/// Local planners connect both ends to the roadmap of representatives, which is then searched. The
/// contacts of an end that algorithms 1 and 2 do not link are added to the representatives (Phoka
/// 2010, 6.2.4).
///
/// If that fails and `last_resort` is set, the grasps of both ends' contacts are searched, at most
/// 70. Then the grasps of all contact points are searched, best first from both ends.
/// @param clusters  clusters of the roadmap, with the contacts of start and goal.
/// @param oracle    evaluator of the contacts in `clusters`; admits both ends.
[[nodiscard]] ContactChain FindContactChain(const ClusteredRoadmap& roadmap,
                                            const ContactClusters& clusters, GraspOracle& oracle,
                                            const Quadruple& start, const Quadruple& goal,
                                            bool last_resort);

/// Largest number of replacements that the last resort evaluates.
inline constexpr std::int64_t kMostLastResortSteps = 5'000'000;

}  // namespace regrasp::roadmap
