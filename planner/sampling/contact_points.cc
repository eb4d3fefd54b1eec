#include "planner/sampling/contact_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <queue>
#include <stdexcept>
#include <string>
#include <utility>

#include "planner/base/random.h"
#include "planner/object/read_object.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp::sampling {

namespace {

// Parameters recommended by the paper.
constexpr int kAlpha = 8;
constexpr double kBeta = 0.65;
constexpr double kGamma = 1.5;

/// Weight of a pair of contacts as a function of their distance.
class Crowding {
 public:
  Crowding(std::size_t from, int to, double area)
      : reach_(2 * LargestRadius(to, area)),
        floor_(reach_ * (1 - std::pow(double(to) / double(from), kGamma)) * kBeta) {}

  [[nodiscard]] double reach() const { return reach_; }

  [[nodiscard]] double operator()(const grasp::Contact& a, const grasp::Contact& b) const {
    const double distance = (a.p - b.p).norm();
    if (distance >= reach_ || a.n.dot(b.n) < std::cos(kOppositeAngle)) return 0;
    return std::pow(1 - std::max(distance, floor_) / reach_, kAlpha);
  }

 private:
  /// Return the radius of `count` equal discs in the densest packing on the area.
  static double LargestRadius(int count, double area) {
    return std::sqrt(area / (2 * std::numbers::sqrt3 * count));
  }

  double reach_;
  double floor_;
};

/// Contact within reach of another one, with the weight of the pair.
struct Neighbour {
  std::size_t index;
  double weight;
};

/// Return the neighbours of each contact in ascending order, so that sums of weights are
/// deterministic.
/// Sweeps along x, because only neighbours within reach count.
std::vector<std::vector<Neighbour>> FindNeighbours(const std::vector<grasp::Contact>& contacts,
                                                   const Crowding& crowding) {
  std::vector<std::size_t> along_x(contacts.size());
  std::iota(along_x.begin(), along_x.end(), std::size_t{0});
  std::sort(along_x.begin(), along_x.end(),
            [&](auto a, auto b) { return contacts[a].p.x() < contacts[b].p.x(); });
  std::vector<std::vector<Neighbour>> neighbours(contacts.size());
  for (std::size_t i = 0; i < along_x.size(); ++i) {
    const std::size_t a = along_x[i];
    const double last_x = contacts[a].p.x() + crowding.reach();
    for (std::size_t j = i + 1; j < along_x.size(); ++j) {
      const std::size_t b = along_x[j];
      if (contacts[b].p.x() > last_x) break;
      const double weight = crowding(contacts[a], contacts[b]);
      if (weight == 0) continue;
      neighbours[a].push_back({b, weight});
      neighbours[b].push_back({a, weight});
    }
  }
  for (auto& list : neighbours) {
    std::sort(list.begin(), list.end(),
              [](const Neighbour& a, const Neighbour& b) { return a.index < b.index; });
  }
  return neighbours;
}

/// Contact with its weight at the time of insertion.
struct Weighed {
  double weight;
  std::size_t index;
  /// Order of a heap with the largest weight on top; ties go to the first contact.
  bool operator<(const Weighed& other) const {
    return weight != other.weight ? weight < other.weight : index > other.index;
  }
};

}  // namespace

std::vector<grasp::Contact> EliminateSamples(const std::vector<grasp::Contact>& contacts, int count,
                                             double area) {
  if (contacts.size() <= static_cast<std::size_t>(count)) return contacts;
  const auto neighbours = FindNeighbours(contacts, {contacts.size(), count, area});
  std::vector<double> weight(contacts.size(), 0);
  std::priority_queue<Weighed> heaviest;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (const Neighbour& other : neighbours[i]) weight[i] += other.weight;
    heaviest.push({weight[i], i});
  }
  std::vector<bool> gone(contacts.size(), false);
  for (std::size_t left = contacts.size(); left > static_cast<std::size_t>(count);) {
    const auto [weight_then, i] = heaviest.top();
    heaviest.pop();
    // Weights only decrease: an unchanged one is the largest.
    if (weight[i] != weight_then) {
      heaviest.push({weight[i], i});
      continue;
    }
    gone[i] = true;
    --left;
    for (const Neighbour& other : neighbours[i]) weight[other.index] -= other.weight;
  }
  std::vector<grasp::Contact> result;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (!gone[i]) result.push_back(contacts[i]);
  }
  return result;
}

namespace {

/// Largest triangle of a fine mesh, relative to the area per point.
constexpr double kFineTriangle = 0.25;

bool IsFine(const object::Polyhedron& solid, double area_per_point) {
  for (object::TriangleIndex i{0}; i < std::ssize(solid.triangles()); ++i) {
    if (TriangleArea(solid, i) > kFineTriangle * area_per_point) return false;
  }
  return true;
}

grasp::Contact TriangleCentroid(const object::Polyhedron& solid, object::TriangleIndex triangle) {
  const auto& [a, b, c] = solid.triangles()[triangle];
  const auto& v = solid.vertices();
  return ContactOnTriangle(solid, triangle, (v[a] + v[b] + v[c]) / 3);
}

std::vector<grasp::Contact> DrawCandidates(const object::Polyhedron& solid, int count,
                                           std::uint64_t seed) {
  const SurfaceSampler sampler(solid);
  const bool fine = IsFine(solid, sampler.measure() / count);
  RandomStream random(seed, RandomUse::kContactPoints);
  std::vector<bool> taken(solid.triangles().size(), false);
  std::vector<grasp::Contact> candidates;
  for (int draw = 0; draw < count * kCandidatesPerPoint; ++draw) {
    if (!fine) {
      candidates.push_back(sampler.DrawAnywhere(random));
      continue;
    }
    const object::TriangleIndex triangle = sampler.DrawTriangle(random);
    if (!taken[triangle]) candidates.push_back(TriangleCentroid(solid, triangle));
    taken[triangle] = true;
  }
  return candidates;
}

/// Remove candidates that are too near the border of their face.
std::vector<grasp::Contact> KeepFromBorders(const object::Polyhedron& solid,
                                            const std::vector<grasp::Contact>& all) {
  std::vector<double> distance(all.size());
  std::vector<double> deepest(solid.face_count(), 0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    distance[i] = solid.DistanceToBorder(all[i].face, all[i].p);
    deepest[all[i].face] = std::max(deepest[all[i].face], distance[i]);
  }
  std::vector<grasp::Contact> kept;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double clearance =
        std::min(kBorderMargin * solid.diameter(), kBorderFraction * deepest[all[i].face]);
    if (distance[i] >= clearance) kept.push_back(all[i]);
  }
  return kept;
}

}  // namespace

std::vector<grasp::Contact> SpreadContactPoints(const object::Polyhedron& solid, int count,
                                                std::uint64_t seed) {
  if (count < 1) throw std::invalid_argument("a roadmap requires at least one contact point");
  const std::vector<grasp::Contact> candidates =
      KeepFromBorders(solid, DrawCandidates(solid, count, seed));
  return EliminateSamples(candidates, count, SurfaceSampler(solid).measure());
}

std::vector<grasp::Contact> MeshContacts(const object::Polyhedron& solid, int most,
                                         std::uint64_t seed) {
  if (most < 1) throw std::invalid_argument("a roadmap requires at least one contact point");
  const int triangles = static_cast<int>(solid.triangles().size());
  const bool few_faces = std::int64_t{kFewFaces} * solid.face_count() < most;
  if (triangles > most || few_faces) return SpreadContactPoints(solid, most, seed);
  std::vector<grasp::Contact> points;
  for (object::TriangleIndex i{0}; i < triangles; ++i) {
    if (!solid.TakesFingers(solid.face_of_triangle(i))) continue;
    points.push_back(TriangleCentroid(solid, i));
  }
  return points;
}

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
  if (most < 1) throw std::invalid_argument("a roadmap requires at least one contact point");
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
                  "; a point must be on the surface, but not on an edge, a rough place "
                  "(--patch roughness) or filled surface"};
  }
  return EliminateSamples(found, most, SurfaceSampler(solid).measure());
}

}  // namespace regrasp::sampling
