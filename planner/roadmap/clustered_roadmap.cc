#include "planner/roadmap/clustered_roadmap.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "planner/base/error.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/criteria/reach.h"
#include "planner/object/polyhedron.h"
#include "planner/sampling/contact_points.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp::roadmap {

namespace {

Roadmap BuildRepresentativeRoadmap(const object::Polyhedron& solid, const ContactClusters& clusters,
                                   const ClusteredRoadmapOptions& options) {
  std::vector<grasp::Contact> representatives;
  for (const int contact : clusters.representatives()) {
    representatives.push_back(clusters.contacts()[contact]);
  }
  return Roadmap(std::move(representatives), solid.wrench_frame(), options.friction_angle,
                 criteria::kSamePoint * solid.diameter(), options.finger_radius, options.deadline,
                 options.progress);
}

}  // namespace

ContactClusters ClusterContacts(const object::Polyhedron& solid,
                                const ClusteredRoadmapOptions& options) {
  if (options.clusters < kFewestClusters || options.clusters > kMostClusters) {
    throw std::invalid_argument("the number of clusters must be within its limits");
  }
  options.progress("choosing contact points");
  std::vector<grasp::Contact> contacts =
      options.given_points == nullptr
          ? sampling::MeshContacts(solid, options.contacts, options.seed)
          : sampling::GivenContacts(solid, *options.given_points, kFewestClusters + 1,
                                    options.contacts, options.seed);
  CountedProgress progress(options.progress, "testing the clearance of contact points",
                           std::ssize(contacts));
  std::erase_if(contacts, [&](const grasp::Contact& contact) {
    options.deadline.Check();
    progress.Add();
    return !criteria::CanRest(solid, contact) ||
           !criteria::CanReach(solid, contact, options.finger_radius);
  });
  const int clusters = std::min(options.clusters, static_cast<int>(contacts.size()) - 1);
  return ContactClusters(std::move(contacts), solid.wrench_frame(), options.friction_angle,
                         clusters, options.seed, options.deadline, options.progress);
}

ClusteredRoadmap::ClusteredRoadmap(const object::Polyhedron& solid,
                                   const ClusteredRoadmapOptions& options)
    : friction_angle(options.friction_angle),
      frame(solid.wrench_frame()),
      clusters(ClusterContacts(solid, options)),
      roadmap(BuildRepresentativeRoadmap(solid, clusters, options)),
      components(roadmap.FindComponents(options.deadline)) {}

namespace {

ContactClusters ClustersOf(const object::Polyhedron& solid, const plan::Plan& plan,
                           const std::vector<Eigen::Vector3d>* given_points) {
  const plan::RoadmapNote& note = *plan.roadmap;
  const auto check = [](const char* name, int value, int least, int most) {
    if (value >= least && value <= most) return;
    throw InputError(std::string("plan: number of ") + name + " of the roadmap: expected " +
                     std::to_string(least) + " to " + std::to_string(most) + ", found " +
                     std::to_string(value));
  };
  check("contact points", note.contacts, kFewestClusters, kMaxClusteredContacts);
  check("clusters", note.clusters, kFewestClusters, kMostClusters);
  ClusteredRoadmapOptions options;
  options.friction_angle = plan.friction_angle - note.roughness.value_or(0);
  if (options.friction_angle <= 0) {
    throw InputError("plan: /roadmap: the roughness must be less than the friction angle");
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

std::optional<int> FindContact(const std::vector<grasp::Contact>& points,
                               const grasp::Contact& contact, double tolerance) {
  const auto found = std::find_if(points.begin(), points.end(), [&](const grasp::Contact& point) {
    return point.face == contact.face && (point.p - contact.p).norm() <= tolerance;
  });
  if (found == points.end()) return std::nullopt;
  return static_cast<int>(found - points.begin());
}

namespace {

constexpr int kPlainContacts = 60;
constexpr int kClusteredContacts = 1000;
constexpr int kClusters = 50;

const object::Polyhedron& SolidOf(const planning::PlanRequest& request) {
  return dynamic_cast<const object::Polyhedron&>(*request.object);
}

void CheckSize(const RoadmapSize& size) {
  const int most = size.clusters > 0 ? kMaxClusteredContacts : kMaxRoadmapContacts;
  if (size.contacts < kRoadmapContacts || size.contacts > most) {
    throw std::invalid_argument("the number of contact points must be within its limits");
  }
}

void JoinContacts(std::vector<grasp::Contact>& points, const std::vector<grasp::Contact>& more,
                  double tolerance) {
  for (const grasp::Contact& contact : more) {
    if (!FindContact(points, contact, tolerance)) points.push_back(contact);
  }
}

}  // namespace

RoadmapSize SizeOf(const planning::PlanRequest& request) {
  const auto parameters = request.parameters.Get<RoadmapParameters>();
  const std::optional<int>& contacts = parameters.contact_points;
  const bool many = contacts.value_or(request.object->face_count()) > kMaxRoadmapContacts;
  const int clusters = parameters.clusters.value_or(many ? kClusters : 0);
  return {contacts.value_or(clusters > 0 ? kClusteredContacts : kPlainContacts), clusters};
}

std::vector<grasp::Contact> SpreadContacts(const planning::PlanRequest& request) {
  const RoadmapSize size = SizeOf(request);
  CheckSize(size);
  request.progress("sampling " + std::to_string(size.contacts) + " contact points");
  std::vector<grasp::Contact> contacts =
      request.given_points == nullptr
          ? sampling::SpreadContactPoints(SolidOf(request), size.contacts, request.seed)
          : sampling::GivenContacts(SolidOf(request), *request.given_points, kRoadmapContacts,
                                    size.contacts, request.seed);
  std::erase_if(contacts, [&](const grasp::Contact& contact) {
    return request.object->IsRough(contact.face, contact.p) ||
           !criteria::CanReach(*request.object, contact, request.hand.fingertip_radius);
  });
  return contacts;
}

Roadmap BuildRoadmap(const planning::PlanRequest& request,
                     const std::vector<grasp::Contact>& contacts,
                     const std::vector<grasp::Contact>& joined) {
  const double diameter = request.object->diameter();
  std::vector<grasp::Contact> points;
  JoinContacts(points, joined, object::kPointTolerance * diameter);
  JoinContacts(points, contacts, object::kPointTolerance * diameter);
  return Roadmap(std::move(points), request.object->wrench_frame(), request.criteria.friction_angle,
                 criteria::kSamePoint * diameter, request.hand.fingertip_radius, request.deadline,
                 request.progress);
}

ClusteredRoadmap BuildClusteredRoadmap(const planning::PlanRequest& request) {
  const RoadmapSize size = SizeOf(request);
  CheckSize(size);
  return ClusteredRoadmap(SolidOf(request), {.friction_angle = request.criteria.friction_angle,
                                             .contacts = size.contacts,
                                             .clusters = size.clusters,
                                             .seed = request.seed,
                                             .progress = request.progress,
                                             .finger_radius = request.hand.fingertip_radius,
                                             .deadline = request.deadline,
                                             .given_points = request.given_points});
}

}  // namespace regrasp::roadmap
