#include "sim/hand_grasps/grasp_geometry.h"

#include <algorithm>

#include "planner/kinematics/derive_couplings.h"
#include "sim/actuation/tip_geometry.h"

namespace regrasp::sim {

using Eigen::Vector3d;

GraspGeometry::GraspGeometry(const GraspWorld& world, const object::Polyhedron& solid, double scale)
    : penetration_(solid, scale), surface_(solid, scale) {
  for (const int body : world.links()) {
    links_.push_back(
        {body, CollisionShapesOf(world.model(), kinematics::BodyName(world.model(), body))});
  }
}

void GraspGeometry::MeasureShape(const collision::ConvexShape& shape, LinkTouch& touch) const {
  const double outside = penetration_.surface().DistanceFrom(shape, kFarthest);
  const bool is_inside = outside == 0 || penetration_.Contains(shape.points.front());
  const double depth = is_inside ? penetration_.Depth(shape, kDeepest, Vector3d::Zero()) : 0;
  touch.distance = std::min(touch.distance, depth > 0 ? -depth : outside);
  if (outside > kContactDistance) return;
  const collision::BoundingSphere sphere = collision::BoundingSphereOf(shape);
  collision::TreeShape grown(shape);
  grown.radius += kContactDistance;
  const double reach = sphere.radius + kContactDistance + collision::kMostInside;
  for (collision::SurfaceContact contact :
       collision::FindContacts(surface_, grown, surface_.Around(sphere.centre, reach))) {
    contact.gap += kContactDistance;
    touch.contacts.push_back(contact);
  }
}

std::vector<LinkTouch> GraspGeometry::Measure(const GraspWorld& world) const {
  std::vector<LinkTouch> touches;
  const Eigen::Isometry3d to_object = world.object_pose().inverse();
  for (const Link& link : links_) {
    LinkTouch& touch = touches.emplace_back();
    touch.link = link.body;
    touch.name = kinematics::BodyName(world.model(), link.body);
    touch.distance = kFarthest;
    const Eigen::Isometry3d pose =
        to_object * kinematics::PoseAt(world.data().xpos, world.data().xmat, link.body);
    for (const collision::ConvexShape& shape : link.shapes) {
      MeasureShape(collision::Moved(pose, shape), touch);
    }
  }
  return touches;
}

double SmallestDistance(const std::vector<LinkTouch>& touches) {
  double least = GraspGeometry::kFarthest;
  for (const LinkTouch& touch : touches) least = std::min(least, touch.distance);
  return least;
}

}  // namespace regrasp::sim
