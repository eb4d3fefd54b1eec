#include "planner/collision/shape_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/collision/convex_shape.h"

namespace regrasp::collision {
namespace {

using Eigen::Vector3d;

/// Distance within which points are identical, metres.
constexpr double kSamePoint = 1e-9;

/// Return the nearest point of a triangle (Ericson, Real-Time Collision Detection, 2005, 5.1.5).
Vector3d ClosestOnTriangle(const Vector3d& p, const std::array<Vector3d, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Vector3d ab = b - a;
  const Vector3d ac = c - a;
  const double d1 = ab.dot(p - a);
  const double d2 = ac.dot(p - a);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = ab.dot(p - b);
  const double d4 = ac.dot(p - b);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const double d5 = ab.dot(p - c);
  const double d6 = ac.dot(p - c);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  }
  const double sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

}  // namespace

BallContact::BallContact(const object::Polyhedron& solid, double scale) {
  for (const auto& [a, b, c] : solid.triangles()) {
    Triangle triangle{
        {scale * solid.vertices()[a], scale * solid.vertices()[b], scale * solid.vertices()[c]},
        Vector3d::Zero(),
        Vector3d::Zero(),
        0};
    const auto& corners = triangle.corners;
    triangle.normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
    for (const Vector3d& corner : triangle.corners) triangle.middle += corner / 3;
    for (const Vector3d& corner : triangle.corners) {
      triangle.radius = std::max(triangle.radius, (corner - triangle.middle).norm());
    }
    triangles_.push_back(triangle);
  }
}

Vector3d BallContact::ClosestOn(int triangle, const Vector3d& point) const {
  return ClosestOnTriangle(point, triangles_[triangle].corners);
}

std::vector<int> BallContact::Around(const Vector3d& centre, double reach) const {
  std::vector<int> near;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const double limit = triangles_[i].radius + reach;
    if ((triangles_[i].middle - centre).squaredNorm() <= limit * limit) {
      near.push_back(static_cast<int>(i));
    }
  }
  return near;
}

std::vector<NearPoint> BallContact::Find(const Vector3d& centre, double reach) const {
  return Find(centre, reach, Around(centre, reach));
}

std::vector<NearPoint> BallContact::Find(const Vector3d& centre, double reach,
                                         const std::vector<int>& among) const {
  struct Candidate {
    NearPoint near;
    const Triangle* triangle;
  };
  std::vector<Candidate> candidates;
  for (const int index : among) {
    const Triangle& triangle = triangles_[index];
    const double limit = triangle.radius + reach;
    if ((triangle.middle - centre).squaredNorm() > limit * limit) continue;
    const Vector3d point = ClosestOnTriangle(centre, triangle.corners);
    const double distance = (centre - point).norm();
    if (distance > reach || distance < kSamePoint) continue;
    const auto& [a, b, c] = triangle.corners;
    if ((b - a).cross(c - a).dot(centre - a) <= 0) continue;
    candidates.push_back({{point, (centre - point) / distance, distance}, &triangle});
  }
  std::ranges::sort(candidates, {}, [](const Candidate& c) { return c.near.distance; });
  std::vector<NearPoint> found;
  for (const Candidate& candidate : candidates) {
    const Vector3d& point = candidate.near.point;
    const bool known = std::ranges::any_of(found, [&](const NearPoint& other) {
      return (other.point - point).squaredNorm() < kSamePoint * kSamePoint;
    });
    // A border point of a triangle is not a minimum if the adjacent triangle is nearer.
    const bool minimum = std::ranges::none_of(candidates, [&](const Candidate& other) {
      return other.near.distance < candidate.near.distance - kSamePoint &&
             (ClosestOnTriangle(point, other.triangle->corners) - point).norm() < kSamePoint;
    });
    if (!known && minimum) found.push_back(candidate.near);
  }
  return found;
}

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
