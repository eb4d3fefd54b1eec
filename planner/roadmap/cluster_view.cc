#include "planner/roadmap/cluster_view.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "planner/base/error.h"
#include "planner/roadmap/build_roadmap.h"
#include "planner/roadmap/clustered_roadmap.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp::roadmap {

namespace {

ContactClusters ClustersOf(const object::Polyhedron& solid, const plan::Plan& plan,
                           const std::vector<Eigen::Vector3d>* given_points) {
  const plan::RoadmapNote& note = *plan.roadmap;
  const auto check = [](const char* name, int value, int least, int most) {
    if (value >= least && value <= most) return;
    throw InputError(std::string("plan: roadmap with ") + std::to_string(value) + " " + name +
                     " is not a roadmap of clusters");
  };
  check("contact points", note.contacts, kFewestClusters, kMaxClusteredContacts);
  check("clusters", note.clusters, kFewestClusters, kMostClusters);
  ClusteredRoadmapOptions options;
  options.friction_angle = plan.friction_angle - note.roughness.value_or(0);
  if (options.friction_angle <= 0) {
    throw InputError("plan: the roughness of the roadmap must be smaller than the friction angle");
  }
  options.contacts = note.contacts;
  options.clusters = note.clusters;
  options.seed = note.seed;
  options.finger_radius = plan.finger_radius.value_or(0);
  options.given_points = given_points;
  return ClusterContacts(solid, options);
}

/// Return the nearest contact whose normal is not opposite.
int NearestContact(const std::vector<grasp::Contact>& contacts, const grasp::Contact& to) {
  int nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < static_cast<int>(contacts.size()); ++i) {
    if (contacts[i].n.dot(to.n) < 0) continue;
    const double distance = (contacts[i].p - to.p).squaredNorm();
    if (distance < least) {
      least = distance;
      nearest = i;
    }
  }
  return nearest;
}

std::vector<ClusterIndex> ClusterOfTriangles(const object::Polyhedron& solid,
                                             const ContactClusters& clusters) {
  std::vector<ClusterIndex> cluster_of;
  for (object::TriangleIndex i{0}; i < std::ssize(solid.triangles()); ++i) {
    const auto& [a, b, c] = solid.triangles()[i];
    const auto& v = solid.vertices();
    const grasp::Contact centroid = sampling::ContactOnTriangle(solid, i, (v[a] + v[b] + v[c]) / 3);
    cluster_of.push_back(clusters.cluster_of(NearestContact(clusters.contacts(), centroid)));
  }
  return cluster_of;
}

/// Return the clusters that each cluster shares a triangle edge with.
std::vector<std::set<ClusterIndex>> Neighbours(const object::Polyhedron& solid,
                                               const std::vector<ClusterIndex>& cluster_of,
                                               int cluster_count) {
  std::map<std::pair<int, int>, ClusterIndex> cluster_at_edge;
  std::vector<std::set<ClusterIndex>> neighbours(cluster_count);
  for (std::size_t i = 0; i < cluster_of.size(); ++i) {
    const auto& corners = solid.triangles()[i];
    for (int k = 0; k < 3; ++k) {
      const std::pair<int, int> edge = std::minmax(corners[k], corners[(k + 1) % 3]);
      const auto [entry, is_new] = cluster_at_edge.emplace(edge, cluster_of[i]);
      if (is_new || entry->second == cluster_of[i]) continue;
      neighbours[entry->second].insert(cluster_of[i]);
      neighbours[cluster_of[i]].insert(entry->second);
    }
  }
  return neighbours;
}

/// Colour clusters greedily, those with most neighbours first (Welsh and Powell 1967).
/// If all colours are used by neighbours, the one of the fewest neighbours is chosen.
std::vector<int> ColorClusters(const std::vector<std::set<ClusterIndex>>& neighbours) {
  std::vector<ClusterIndex> order;
  for (ClusterIndex i{0}; i < std::ssize(neighbours); ++i) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](ClusterIndex a, ClusterIndex b) {
    return neighbours[a].size() > neighbours[b].size();
  });
  std::vector<int> color(neighbours.size(), -1);
  int turn = 0;
  for (const ClusterIndex cluster : order) {
    std::array<int, kClusterColors> taken{};
    for (const ClusterIndex other : neighbours[cluster]) {
      if (color[other] >= 0) ++taken[color[other]];
    }
    // Start at a different colour each time, so that all colours are used about equally.
    int best = turn % kClusterColors;
    for (int i = 0; i < kClusterColors; ++i) {
      const int next = (turn + i) % kClusterColors;
      if (taken[next] < taken[best]) best = next;
    }
    color[cluster] = best;
    ++turn;
  }
  return color;
}

}  // namespace

ClusterView DescribeClusters(const object::Polyhedron& solid, const plan::Plan& plan,
                             const std::vector<Eigen::Vector3d>* given_points) {
  const ContactClusters clusters = ClustersOf(solid, plan, given_points);
  ClusterView view;
  const std::vector<ClusterIndex> cluster_of = ClusterOfTriangles(solid, clusters);
  const std::vector<int> color =
      ColorClusters(Neighbours(solid, cluster_of, clusters.cluster_count()));
  for (const ClusterIndex cluster : cluster_of) view.color_of_triangle.push_back(color[cluster]);
  for (const int contact : clusters.representatives()) {
    view.representatives.push_back(clusters.contacts()[contact].p);
  }
  return view;
}

}  // namespace regrasp::roadmap
