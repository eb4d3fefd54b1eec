#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "planner/roadmap/contact_clusters.h"
#include "planner/roadmap/grasp_tree.h"
#include "planner/roadmap/roadmap.h"

namespace regrasp::roadmap {

/// The clusters of a grasp's contacts. A roadmap of representatives numbers its points as their
/// clusters are: its vertices are found by clusters, not by contacts.
using FourClusters = std::array<ClusterIndex, 4>;
[[nodiscard]] FourClusters ClustersOf(const ContactClusters& clusters, const Quadruple& grasp);

/// The vertex of the representatives of four clusters.
[[nodiscard]] std::optional<int> FindVertex(const Roadmap& roadmap, const FourClusters& clusters);

/// How a grasp came to the representative roadmap.
enum class RoadmapLink {
  kNone,        ///< not at all
  kVertex,      ///< it is one of its vertices
  kAlgorithm1,  ///< to the grasp of its own clusters' representatives
  kAlgorithm2,  ///< to one that differs from that in one cluster
  kAlgorithm3,  ///< with its own contacts taken among the representatives
};

/// "vertex", "algorithm-1", …, as plans name it.
[[nodiscard]] const char* RoadmapLinkName(RoadmapLink link);

/// The local planners between grasps of any contact points and the roadmap of the representatives
/// (Phoka 2010, 6.2.4, Algorithms 1, 2 and 3), each with its grasps tested when they are reached.
class LocalPlanners {
 public:
  /// @param clusters  with all contacts that grasps are made of.
  /// @param roadmap   its points are the representatives of the clusters, in their order.
  /// @param oracle    of the contacts of `clusters`. All must outlive this object.
  LocalPlanners(const ContactClusters& clusters, const Roadmap& roadmap, GraspOracle& oracle);

  /// A path from a grasp to a vertex of the roadmap, both included; empty where there is none.
  struct Path {
    RoadmapLink link = RoadmapLink::kNone;
    std::vector<Quadruple> grasps;
  };
  /// The first of the algorithms that finds one, in their order. A grasp that is a vertex itself
  /// needs none.
  [[nodiscard]] Path Link(const Quadruple& grasp);

  /// Where the algorithms 1 and 2 would lead: the vertex of the representatives of the grasp's
  /// clusters; and the vertex that differs from these in one cluster, whose centre is nearest to
  /// the contact that moves there. nullopt where there is no such vertex (that is admitted).
  [[nodiscard]] std::optional<Quadruple> OwnRepresentatives(const Quadruple& grasp);
  struct NearestCluster {
    Quadruple vertex;      ///< contacts
    int slot = 0;          ///< of the grasp's contact that moves
    ClusterIndex cluster;  ///< to this one
  };
  [[nodiscard]] std::optional<NearestCluster> FindNearestCluster(const Quadruple& grasp);

  /// The algorithms one by one; empty where they don't apply or find no path.
  [[nodiscard]] std::vector<Quadruple> RunAlgorithm1(const Quadruple& grasp);
  [[nodiscard]] std::vector<Quadruple> RunAlgorithm2(const Quadruple& grasp);
  [[nodiscard]] std::vector<Quadruple> RunAlgorithm3(const Quadruple& grasp);

 private:
  /// The number of a roadmap's vertex, of contacts.
  [[nodiscard]] bool IsVertex(const Quadruple& grasp);
  /// Contacts near both `contact` and the representative of `cluster`, and both of them: S_i.
  [[nodiscard]] std::vector<int> Between(int contact, ClusterIndex cluster) const;
  /// A path by contacts of the sets between each contact of the grasp and its cluster.
  [[nodiscard]] std::vector<Quadruple> JoinWithin(const Quadruple& grasp,
                                                  const FourClusters& clusters,
                                                  const Quadruple& goal);

  const ContactClusters& clusters_;
  const Roadmap& roadmap_;
  GraspOracle& oracle_;
};

/// Replacements that one search looks at before it gives up.
inline constexpr std::int64_t kMostLocalSteps = 2'000'000;

}  // namespace regrasp::roadmap
