#include "planner/roadmap/clustered_roadmap.h"

#include <gtest/gtest.h>

#include <vector>

#include "planner/base/number.h"
#include "planner/object/object.h"
#include "planner/object/polyhedron.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::roadmap {
namespace cluster_view_test {

const double kFrictionAngle = Radians(20), kRoughness = Radians(5);

/// Read a mug that is rough near the edges of its triangles only.
object::Polyhedron ReadMug(const object::Reading& reading) {
  return dynamic_cast<const object::Polyhedron&>(
      *object::ReadObject(ProjectPath("models/mug500.obj"), reading).object);
}

object::Reading ReadingOfPatches() {
  object::Reading reading;
  reading.patch = {std::nullopt, kRoughness};
  return reading;
}

/// Return the request of the program `plan` for a roadmap.
planning::PlanRequest RequestOn(const object::Polyhedron& solid, double friction_angle) {
  planning::PlanRequest request;
  request.object = &solid;
  request.criteria.friction_angle = friction_angle;
  request.seed = 3;
  request.parameters.Edit<RoadmapParameters>().contact_points = 200;
  request.parameters.Edit<RoadmapParameters>().clusters = 10;
  return request;
}

plan::Plan PlanOver() {
  plan::Plan plan;
  plan.friction_angle = kFrictionAngle;
  plan.roadmap = plan::RoadmapNote{200, 10, 3, "vertex", "vertex"};
  return plan;
}

std::vector<Eigen::Vector3d> RepresentativesOf(const ContactClusters& clusters) {
  std::vector<Eigen::Vector3d> points;
  for (const int contact : clusters.representatives()) {
    points.push_back(clusters.contacts()[contact].p);
  }
  return points;
}

TEST(DescribeClusters, FindsThoseOfAPlanAgain) {
  const object::Polyhedron solid = ReadMug({});
  const ClusteredRoadmap roadmap = BuildClusteredRoadmap(RequestOn(solid, kFrictionAngle));
  EXPECT_EQ(DescribeClusters(solid, PlanOver()).representatives,
            RepresentativesOf(roadmap.clusters));
}

TEST(DescribeClusters, FindsThoseOfAPlanWithPatchesAgain) {
  const object::Polyhedron solid = ReadMug(ReadingOfPatches());
  const ClusteredRoadmap roadmap =
      BuildClusteredRoadmap(RequestOn(solid, kFrictionAngle - kRoughness));
  plan::Plan plan = PlanOver();
  plan.roadmap->roughness = kRoughness;
  const std::vector<Eigen::Vector3d> found = DescribeClusters(solid, plan).representatives;
  EXPECT_EQ(found, RepresentativesOf(roadmap.clusters));
  // Controls: the representatives differ without contact patches, and with the full friction angle.
  EXPECT_NE(DescribeClusters(ReadMug({}), plan).representatives, found);
  plan.roadmap->roughness.reset();
  EXPECT_NE(DescribeClusters(solid, plan).representatives, found);
}

TEST(DescribeClusters, FindsThoseOfThickFingersAgain) {
  const object::Polyhedron solid = ReadMug({});
  planning::PlanRequest request = RequestOn(solid, kFrictionAngle);
  request.hand.fingertip_radius = 0.1 * solid.diameter();
  const ClusteredRoadmap roadmap = BuildClusteredRoadmap(request);
  plan::Plan plan = PlanOver();
  plan.finger_radius = request.hand.fingertip_radius;
  const std::vector<Eigen::Vector3d> found = DescribeClusters(solid, plan).representatives;
  EXPECT_EQ(found, RepresentativesOf(roadmap.clusters));
  plan.finger_radius.reset();  // control
  EXPECT_NE(DescribeClusters(solid, plan).representatives, found);
}

}  // namespace cluster_view_test
}  // namespace regrasp::roadmap
