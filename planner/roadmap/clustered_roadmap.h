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

/// Limits of the number of clusters. More representatives exceed the memory of a small machine.
inline constexpr int kFewestClusters = 4;
inline constexpr int kMostClusters = 200;

struct ClusteredRoadmapOptions {
  double friction_angle = 0;  ///< friction angle, radians in (0, π/2)
  int contacts = 1000;        ///< largest number of contact points
  int clusters = 50;          ///< kFewestClusters … kMostClusters
  std::uint64_t seed = 0;
  /// Callback for progress messages.
  std::function<void(std::string_view)> progress = [](std::string_view) {};
  double finger_radius = 0;  ///< radius of the fingers; 0: points (reach.h)
  Deadline deadline = {};    ///< deadline of the construction, which then throws TimeUp
  /// Points to which contact points are restricted (sampling/contact_points.h); null for none.
  const std::vector<Eigen::Vector3d>* given_points = nullptr;
};

/// Cluster the contact points of a mesh at which a fingertip has clearance.
/// The number of clusters is reduced to at most one less than the number of contact points.
/// @throws std::invalid_argument  if an option is out of range.
/// @throws NoGrasp  if too few of the given points accept a finger.
[[nodiscard]] ContactClusters ClusterContacts(const object::Polyhedron& solid,
                                              const ClusteredRoadmapOptions& options);

/// Clustered contact points of a mesh, with the roadmap of their representatives.
/// The roadmap has all force-closure grasps of four representatives (Phoka 2010, 6.2.2 and 6.2.3).
/// It is constant and can be shared by queries.
struct ClusteredRoadmap {
  /// @throws std::invalid_argument  if an option is out of range.
  ClusteredRoadmap(const object::Polyhedron& solid, const ClusteredRoadmapOptions& options);

  double friction_angle;
  object::WrenchFrame frame;
  ContactClusters clusters;
  Roadmap roadmap;  ///< its points are the representatives in cluster order
  search::Components components;
};

}  // namespace regrasp::roadmap
