#include "planner/sampling/contact_points.h"

#include <algorithm>
#include <stdexcept>

#include "planner/sampling/sample_elimination.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp::sampling {

namespace {

/// The largest triangle, relative to the area of one point, of a mesh that counts as fine.
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

/// Leaves out the candidates that are too near the border of their face.
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
  if (count < 1) throw std::invalid_argument("a roadmap needs at least one contact point");
  const std::vector<grasp::Contact> candidates =
      KeepFromBorders(solid, DrawCandidates(solid, count, seed));
  return EliminateSamples(candidates, count, SurfaceSampler(solid).measure());
}

std::vector<grasp::Contact> MeshContacts(const object::Polyhedron& solid, int most,
                                         std::uint64_t seed) {
  if (most < 1) throw std::invalid_argument("a roadmap needs at least one contact point");
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

}  // namespace regrasp::sampling
