#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/object/polyhedron.h"
#include "planner/roadmap/contact_clusters.h"
#include "planner/roadmap/roadmap.h"
#include "planner/search/switching_graph.h"

namespace regrasp::roadmap {

/// Clusters of a roadmap's contact points: more representatives than this need more memory than a
/// small machine has.
inline constexpr int kFewestClusters = 4;
inline constexpr int kMostClusters = 200;

struct ClusteredRoadmapOptions {
  double half_angle = 0;  ///< friction, radians in (0, π/2)
  int contacts = 1000;    ///< contact points at most
  int clusters = 50;      ///< kFewestClusters … kMostClusters
  std::uint64_t seed = 0;
  /// Told what is being done.
  std::function<void(std::string_view)> progress = [](std::string_view) {};
  double finger_radius = 0;  ///< of fingers that are not points (reach.h)
  Deadline deadline = {};    ///< when building ends by TimeUp
  /// If not null, contact points are at these points only (sampling/given_contacts.h).
  const std::vector<Eigen::Vector3d>* given_points = nullptr;
};

/// The contact points of a mesh at which a fingertip has clearance, in clusters; no more clusters
/// than contact points less one.
/// @throws std::invalid_argument  an option is out of its range.
/// @throws NoGrasp  too few of the given points take a finger.
[[nodiscard]] ContactClusters ClusterContacts(const object::Polyhedron& solid,
                                              const ClusteredRoadmapOptions& options);

/// A mesh's contact points in clusters, and the roadmap of all force-closure grasps of four of the
/// clusters' representatives (Phoka 2010, 6.2.2 and 6.2.3). Queries share it and change nothing.
struct ClusteredRoadmap {
  /// @throws std::invalid_argument  an option is out of its range.
  ClusteredRoadmap(const object::Polyhedron& solid, const ClusteredRoadmapOptions& options);

  double half_angle;
  object::WrenchFrame frame;
  ContactClusters clusters;
  Roadmap roadmap;  ///< its points are the representatives, in the order of their clusters
  search::Components components;
};

}  // namespace regrasp::roadmap
