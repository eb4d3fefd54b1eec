#include "planner/collision/shape_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/collision/hull_distance.h"

namespace regrasp::collision {
namespace {

using Eigen::Vector3d;

/// Tolerance for a point whose nearest surface point is inside a triangle: its distance equals its
/// height over the plane, metres.
constexpr double kOrthogonal = 1e-9;
/// Smallest difference, metres, by which another point must be nearer than a corner.
constexpr double kNearer = 1e-7;

/// Possible contacts of a point of the shape.
struct PointPlace {
  bool near = false;                     ///< within the radius, from outside
  std::optional<SurfaceContact> inside;  ///< contact of a point inside the solid
};

PointPlace PlaceOf(const BallContact& surface, const Vector3d& point, double radius,
                   const std::vector<int>& among) {
  PointPlace place;
  double nearest = std::numeric_limits<double>::infinity();
  for (const int index : among) {
    const Vector3d& normal = surface.normal(index);
    const double height = normal.dot(point - surface.corners(index)[0]);
    if (std::abs(height) > std::max(radius, kMostInside)) continue;
    const Vector3d on_surface = surface.ClosestOn(index, point);
    const double distance = (point - on_surface).norm();
    place.near = place.near || (height > 0 && distance < radius);
    if (distance > kMostInside || distance >= nearest) continue;
    nearest = distance;
    place.inside.reset();
    if (height <= 0 && distance <= -height + kOrthogonal) {
      place.inside = {on_surface, normal, -distance - radius};
    }
  }
  return place;
}

/// Return the triangles that points in a sphere can touch (PlaceOf).
std::vector<int> NearSphere(const BallContact& surface, const BoundingSphere& sphere, double radius,
                            const std::vector<int>& among) {
  const double reach = sphere.radius + std::max(radius, kMostInside);
  std::vector<int> near;
  for (const int index : among) {
    const double height = surface.normal(index).dot(sphere.centre - surface.corners(index)[0]);
    if (std::abs(height) > reach) continue;
    const Vector3d on_surface = surface.ClosestOn(index, sphere.centre);
    if ((sphere.centre - on_surface).norm() <= reach) near.push_back(index);
  }
  return near;
}

void AddPoint(const BallContact& surface, const Vector3d& point, double radius,
              const std::vector<int>& among, std::vector<SurfaceContact>& contacts) {
  const PointPlace place = PlaceOf(surface, point, radius, among);
  if (place.inside) {
    contacts.push_back(*place.inside);
  } else if (place.near) {
    for (const NearPoint& near : surface.Find(point, radius, among)) {
      if (near.distance < radius) {
        contacts.push_back({near.point, near.outward, near.distance - radius});
      }
    }
  }
}

/// Add the contacts of the points of a node of the shape's tree.
void AddPoints(const BallContact& surface, const TreeShape& shape, int index,
               const std::vector<int>& among, std::vector<SurfaceContact>& contacts) {
  const PointTree::Node& node = shape.points.nodes()[index];
  const std::vector<int> near = NearSphere(surface, node.sphere, shape.radius, among);
  if (near.empty()) return;
  if (node.right != 0) {
    AddPoints(surface, shape, index + 1, near, contacts);
    AddPoints(surface, shape, node.right, near, contacts);
    return;
  }
  for (const Vector3d& point : shape.points.PointsOf(node)) {
    AddPoint(surface, point, shape.radius, near, contacts);
  }
}

/// Return a contact if the hull of the points intersects the surface. It is along the line from the
/// surface to the centre of the shape.
std::optional<SurfaceContact> Overlap(const BallContact& surface, const TreeShape& shape,
                                      const std::vector<int>& among) {
  const BoundingSphere around = BoundingSphereOf({shape.points.points(), shape.radius});
  const std::vector<NearPoint> found = surface.Find(around.centre, around.radius, among);
  if (found.empty()) return std::nullopt;
  const NearPoint& near = found.front();
  const Vector3d& deepest = Farthest(shape.points, -near.outward);
  const double depth = std::max(0.0, near.outward.dot(near.point - deepest));
  return SurfaceContact{near.point, near.outward, -depth - shape.radius};
}

/// Return the deepest contacts, without those within kApart of a deeper one.
std::vector<SurfaceContact> Thinned(std::vector<SurfaceContact> contacts) {
  std::ranges::stable_sort(contacts, {}, &SurfaceContact::gap);
  std::vector<SurfaceContact> kept;
  for (const SurfaceContact& contact : contacts) {
    if (std::ssize(kept) == kMostContacts) break;
    const bool adds = std::ranges::none_of(kept, [&](const SurfaceContact& other) {
      return (other.point - contact.point).norm() < kApart;
    });
    if (adds) kept.push_back(contact);
  }
  return kept;
}

}  // namespace

std::vector<SurfaceContact> FindContacts(const BallContact& surface, const TreeShape& shape,
                                         const std::vector<int>& among) {
  std::vector<SurfaceContact> contacts;
  if (shape.points.points().size() == 1) {
    const Vector3d& centre = shape.points.points().front();
    for (const NearPoint& near : surface.Find(centre, shape.radius, among)) {
      if (near.distance < shape.radius) {
        contacts.push_back({near.point, near.outward, near.distance - shape.radius});
      }
    }
    return contacts;
  }
  AddPoints(surface, shape, 0, among, contacts);
  double deepest = 0;
  for (const SurfaceContact& contact : contacts) deepest = std::min(deepest, contact.gap);
  // An additional contact exists only if another part of the shape is nearer than its points. If
  // the hull of the points intersects the surface, the contacts of the points suffice.
  const auto nearest = FindNearest(surface, shape, shape.radius, among);
  const bool meets = nearest && nearest->gap <= -shape.radius;
  if (nearest && (meets ? contacts.empty() : nearest->gap < deepest - kNearer)) {
    contacts.push_back(*nearest);
  }
  return Thinned(std::move(contacts));
}

std::optional<SurfaceContact> FindNearest(const BallContact& surface, const TreeShape& shape,
                                          double reach, const std::vector<int>& among) {
  std::optional<SurfaceContact> best;
  double nearest = reach;
  for (const int index : among) {
    const std::array<Vector3d, 3>& corners = surface.corners(index);
    const Vector3d& normal = surface.normal(index);
    if (normal.dot(Farthest(shape.points, -normal) - corners[0]) >= nearest) continue;
    const std::optional<NearestPair> pair = FindNearestPoints(shape.points, corners, nearest);
    if (!pair) return Overlap(surface, shape, among);
    const Vector3d between = pair->on_a - pair->on_b;
    const double distance = between.norm();
    // A triangle that faces away cannot be the nearest.
    if (distance >= nearest || normal.dot(between) <= 0) continue;
    nearest = distance;
    best = {pair->on_b, between / distance, distance - shape.radius};
  }
  return best;
}

}  // namespace regrasp::collision
