#include "planner/roadmap/clustered_roadmap.h"

#include <algorithm>
#include <stdexcept>

#include "planner/criteria/grasp_evaluator.h"
#include "planner/criteria/reach.h"
#include "planner/sampling/contact_points.h"

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
    throw std::invalid_argument("the number of clusters is out of range");
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

}  // namespace regrasp::roadmap
