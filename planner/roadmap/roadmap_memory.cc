#include "planner/roadmap/roadmap_memory.h"

#include <string>

#include "planner/base/random.h"
#include "planner/grasp/force_closure.h"
#include "planner/object/polyhedron.h"
#include "planner/roadmap/build_roadmap.h"
#include "planner/roadmap/combination_rank.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp::roadmap {

namespace {

constexpr int kContacts = 4;

/// Some hundredths of a second; a share of a tenth is then known to 7 %.
constexpr int kTestedGrasps = 2000;

// Measured on roadmaps of 60 to 200 contact points at 15° to 80°, as the peak of resident memory: a
// vertex with its places in the lists of triples, its component and what a search notes of it; a
// triple in these lists.
constexpr double kBytesOfVertex = 55;
constexpr double kBytesOfTriple = 8;

/// Of each pair of contact points that are clustered: their distance, their affinity and what is
/// made of it for the eigenvalues; 26 to 28 measured on 1000 to 4000 contact points.
constexpr double kBytesOfPair = 27;

double ForceClosureShare(const object::Polyhedron& solid, double half_angle) {
  const sampling::SurfaceSampler sampler(solid);
  RandomStream random(0, RandomUse::kContactPoints);
  int count = 0;
  for (int i = 0; i < kTestedGrasps; ++i) {
    grasp::Grasp grasp;
    for (int k = 0; k < kContacts; ++k) grasp.push_back(sampler.DrawAnywhere(random));
    if (grasp::IsForceClosure(grasp, solid.wrench_frame(), half_angle)) ++count;
  }
  return static_cast<double>(count) / kTestedGrasps;
}

MemoryNeed EstimateGrasps(const object::Polyhedron& solid, double half_angle, int points,
                          const std::string& units) {
  const double share = ForceClosureShare(solid, half_angle);
  const auto bytes_for = [share](int n) {
    return kBytesOfVertex * share * static_cast<double>(Binomial<kContacts>(n)) +
           kBytesOfTriple * static_cast<double>(Binomial<3>(n));
  };
  return {"the graph of the planner roadmap", points, units, bytes_for};
}

}  // namespace

MemoryNeed EstimateRoadmap(const planning::PlanRequest& request) {
  const auto& solid = dynamic_cast<const object::Polyhedron&>(*request.object);
  const RoadmapSize size = SizeOf(request);
  const double half_angle = request.criteria.half_angle;
  if (size.clusters == 0) {
    return EstimateGrasps(solid, half_angle, size.contacts, "contact points");
  }
  MemoryNeed grasps = EstimateGrasps(solid, half_angle, size.clusters, "clusters");
  MemoryNeed clustering = {"the clustering of the planner roadmap", size.contacts, "contact points",
                           [](double n) { return kBytesOfPair * n * n; }};
  return clustering.bytes() > grasps.bytes() ? clustering : grasps;
}

}  // namespace regrasp::roadmap
