#include "planner/sampling/given_contacts.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "planner/base/random.h"
#include "planner/object/read_object.h"
#include "planner/sampling/contact_points.h"
#include "planner/sampling/draw_grasp.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp::sampling {

using Eigen::Vector3d;

namespace {

/// Number of found contacts per kept contact, so that the kept ones can be spread evenly.
constexpr int kFoundPerContact = 4;

struct Circle {
  Vector3d centre;
  double radius;
};

/// Return the incircle of a triangle.
Circle InCircle(const std::array<Vector3d, 3>& t) {
  const double a = (t[1] - t[2]).norm(), b = (t[2] - t[0]).norm(), c = (t[0] - t[1]).norm();
  const double around = a + b + c;
  return {(a * t[0] + b * t[1] + c * t[2]) / around,
          (t[1] - t[0]).cross(t[2] - t[0]).norm() / around};
}

/// Return a point on a face at distance `margin` from its border, near a given point of the face.
/// It is on the line from the point to the incentre of a triangle with a corner there. Its distance
/// from all sides of that triangle is `margin`.
std::optional<Vector3d> PlaceInside(const object::Polyhedron& solid, FaceIndex face,
                                    const Vector3d& on, double margin) {
  if (solid.DistanceToBorder(face, on) >= margin) return on;
  const double same = object::kPointTolerance * solid.diameter();
  std::optional<Vector3d> nearest;
  for (const object::TriangleIndex triangle : solid.TrianglesOf(face)) {
    std::array<Vector3d, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = solid.vertices()[solid.triangles()[triangle][k]];
    if (std::ranges::none_of(corners, [&](const Vector3d& c) { return (c - on).norm() <= same; })) {
      continue;
    }
    const Circle circle = InCircle(corners);
    if (circle.radius < margin) continue;
    const Vector3d place = on + margin / circle.radius * (circle.centre - on);
    if (!nearest || (place - on).norm() < (*nearest - on).norm()) nearest = place;
  }
  return nearest;
}

/// Return the faces nearest to a point. Faces with normals nearest to the mean normal come first.
std::vector<FaceIndex> FacesAt(const object::Polyhedron& solid, const Vector3d& point) {
  std::vector<FaceIndex> faces = solid.FacesNear(point, object::kAtGivenPoint * solid.diameter());
  if (faces.empty()) return faces;
  const auto distance = [&](FaceIndex face) {
    return (solid.ClosestPoint(face, point) - point).norm();
  };
  const double at = distance(faces.front()) + object::kPointTolerance * solid.diameter();
  faces.erase(std::ranges::find_if(faces, [&](FaceIndex face) { return distance(face) > at; }),
              faces.end());
  Vector3d mean = Vector3d::Zero();
  for (const FaceIndex face : faces) mean += solid.inward_normal(face);
  std::ranges::stable_sort(faces, std::ranges::greater(),
                           [&](FaceIndex face) { return solid.inward_normal(face).dot(mean); });
  return faces;
}

}  // namespace

std::optional<grasp::Contact> ContactAt(const object::Polyhedron& solid, const Vector3d& point) {
  const double margin = SurfaceSampler::kFromBorder * solid.diameter();
  for (const FaceIndex face : FacesAt(solid, point)) {
    if (!solid.TakesFingers(face)) continue;
    const auto place = PlaceInside(solid, face, solid.ClosestPoint(face, point), margin);
    if (!place) continue;
    const Vector3d p = solid.ClosestPoint(face, *place);  // removes rounding errors
    if ((p - point).norm() > object::kAtGivenPoint * solid.diameter()) continue;
    if (!solid.IsRough(face, p)) return grasp::Contact{p, solid.inward_normal(face), face};
  }
  return std::nullopt;
}

std::vector<grasp::Contact> GivenContacts(const object::Polyhedron& solid,
                                          std::span<const Vector3d> points, int least, int most,
                                          std::uint64_t seed) {
  if (most < 1) throw std::invalid_argument("a roadmap needs at least one contact point");
  std::vector<Vector3d> left(points.begin(), points.end());
  RandomStream random(seed, RandomUse::kContactPoints);
  std::vector<grasp::Contact> found;
  while (!left.empty() && std::ssize(found) < std::int64_t{kFoundPerContact} * most) {
    std::swap(left[random.Index(left.size())], left.back());
    if (const auto contact = ContactAt(solid, left.back())) found.push_back(*contact);
    left.pop_back();
  }
  if (std::ssize(found) < least) {
    throw NoGrasp{"expected at least " + std::to_string(least) +
                  " given points for fingers, found " + std::to_string(found.size()) + " of " +
                  std::to_string(points.size()) +
                  ": a point must be on the surface, and not on an edge, a rough place "
                  "(--patch roughness) or a filled surface"};
  }
  return EliminateSamples(found, most, SurfaceSampler(solid).measure());
}

}  // namespace regrasp::sampling
