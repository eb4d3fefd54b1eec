#include "render/frames/shaded_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/container_hash/hash.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <unordered_map>
#include <utility>

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

/// Bottom and top of a wedge above the contact plane: above the top of the prism in the depth
/// buffer, and below the middle of a force arrow.
constexpr double kWedgeBottom = 1.8e-3, kWedgeTop = 2.6e-3;

/// Segments of a cone's rim: its outline deviates from a circle by less than 0.1 %.
constexpr int kConeSegments = 72;

/// Segments around a capsule, from its equator to its pole, and around the end of a band.
constexpr int kCapsuleSides = 32;
constexpr int kCapsuleRings = 8;
constexpr int kBandSides = 6;

/// Length of a sum of unit normals, weighted by angles in radians, that counts as zero.
constexpr double kLeastMean = 1e-3;

struct PointHash {
  std::size_t operator()(const std::array<double, 3>& point) const {
    return static_cast<std::size_t>(boost::hash_value(point));
  }
};

/// Return two unit vectors that form a right-handed frame with `axis`.
std::pair<Vector3d, Vector3d> AcrossOf(const Vector3d& axis) {
  const Vector3d u = axis.unitOrthogonal();
  return {u, axis.cross(u)};
}

}  // namespace

void ShadedMesh::AddFlat(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a).normalized();
  triangles.push_back({a, b, c});
  normals.push_back({normal, normal, normal});
}

ShadedMesh TurnInsideOut(ShadedMesh mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    std::swap(mesh.normals[i][1], mesh.normals[i][2]);
    for (Vector3d& normal : mesh.normals[i]) normal = -normal;
  }
  return mesh;
}

WeldedMesh Weld(const ShadedMesh& mesh) {
  WeldedMesh welded;
  std::unordered_map<std::array<double, 3>, int, PointHash> known;
  known.reserve(mesh.triangles.size());
  for (const auto& corners : mesh.triangles) {
    std::array<int, 3>& triangle = welded.triangles.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const Vector3d& p = corners[i];
      const auto count = static_cast<int>(welded.vertices.size());
      const auto [found, is_new] = known.try_emplace({p.x(), p.y(), p.z()}, count);
      if (is_new) welded.vertices.push_back(p);
      triangle[i] = found->second;
    }
  }
  return welded;
}

void Grow(double by, ShadedMesh& mesh) {
  const WeldedMesh welded = Weld(mesh);
  std::vector<Vector3d> sums(welded.vertices.size(), Vector3d::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    const Vector3d across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    if (across.isZero(0)) continue;
    for (int k = 0; k < 3; ++k) {
      const Vector3d u = corners[(k + 1) % 3] - corners[k], v = corners[(k + 2) % 3] - corners[k];
      const double angle = std::atan2(u.cross(v).norm(), u.dot(v));
      sums[welded.triangles[t][k]] += angle * across.normalized();
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Vector3d& sum = sums[welded.triangles[t][k]];
      // The mean of both sides of a sheet has no direction.
      const bool has_mean = sum.norm() > kLeastMean;
      mesh.triangles[t][k] += by * (has_mean ? Vector3d(sum.normalized()) : mesh.normals[t][k]);
    }
  }
}

ShadedMesh MakeShell(ShadedMesh mesh, double width) {
  Grow(width, mesh);
  return TurnInsideOut(std::move(mesh));
}

void ShadedMesh::Add(const std::array<Vector3d, 3>& corners,
                     const std::array<Vector3d, 3>& corner_normals) {
  triangles.push_back(corners);
  normals.push_back(corner_normals);
}

ShadedMesh MakeCone(double friction_angle, double slant) {
  ShadedMesh cone;
  const double sine = std::sin(friction_angle);
  const double cosine = std::cos(friction_angle);
  const auto rim = [&](double i) -> Vector3d {
    const double angle = 2 * std::numbers::pi * i / kConeSegments;
    return slant * Vector3d(sine * std::cos(angle), sine * std::sin(angle), cosine);
  };
  const auto normal = [&](double i) -> Vector3d {
    const double angle = 2 * std::numbers::pi * i / kConeSegments;
    return {cosine * std::cos(angle), cosine * std::sin(angle), -sine};
  };
  for (int i = 0; i < kConeSegments; ++i) {
    cone.triangles.push_back({Vector3d::Zero(), rim(i + 1), rim(i)});
    cone.normals.push_back({normal(i + 0.5), normal(i + 1), normal(i)});
    cone.AddFlat({0, 0, slant * cosine}, rim(i), rim(i + 1));
  }
  return cone;
}

ShadedMesh MakeWedge(double friction_angle, double slant) {
  ShadedMesh wedge;
  const double x = slant * std::sin(friction_angle);
  const double z = slant * std::cos(friction_angle);
  const std::array<Vector3d, 3> corners = {Vector3d::Zero(), Vector3d(x, 0, z), Vector3d(-x, 0, z)};
  const Vector3d low = kWedgeBottom * Vector3d::UnitY(), high = kWedgeTop * Vector3d::UnitY();
  const auto& [a, b, c] = corners;
  wedge.AddFlat(a + high, c + high, b + high);
  wedge.AddFlat(a + low, b + low, c + low);
  for (int i = 0; i < 3; ++i) {
    const Vector3d& p = corners[i];
    const Vector3d& q = corners[(i + 1) % 3];
    wedge.AddFlat(p + low, p + high, q + high);
    wedge.AddFlat(p + low, q + high, q + low);
  }
  return wedge;
}

ShadedMesh MakeCapsule(const Vector3d& from, const Vector3d& to, double radius) {
  const bool is_sphere = (to - from).norm() == 0;
  const Vector3d axis = is_sphere ? Vector3d::UnitZ() : Vector3d((to - from).normalized());
  const auto [u, v] = AcrossOf(axis);
  constexpr int kLast = 2 * kCapsuleRings + 1;
  // Corners share their normals: a capsule is drawn in every frame, and sines take time.
  std::array<std::array<Vector3d, kCapsuleSides + 1>, kLast + 1> normals;
  for (int ring = 0; ring <= kLast; ++ring) {
    const bool far_end = ring > kCapsuleRings;
    const double tilt =
        std::numbers::pi / 2 * ((far_end ? ring - 1 : ring) - kCapsuleRings) / kCapsuleRings;
    for (int side = 0; side <= kCapsuleSides; ++side) {
      const double turn = 2 * std::numbers::pi * side / kCapsuleSides;
      normals[ring][side] =
          std::cos(tilt) * (std::cos(turn) * u + std::sin(turn) * v) + std::sin(tilt) * axis;
    }
  }
  ShadedMesh capsule;
  for (int ring = 0; ring < kLast; ++ring) {
    for (int side = 0; side < kCapsuleSides; ++side) {
      const auto across = [&](int i, int j) -> const Vector3d& {
        return normals[ring + i][side + j];
      };
      const auto corner = [&](int i, int j) -> Vector3d {
        return (ring + i > kCapsuleRings ? to : from) + radius * across(i, j);
      };
      if (ring > 0) {
        capsule.Add({corner(0, 0), corner(0, 1), corner(1, 1)},
                    {across(0, 0), across(0, 1), across(1, 1)});
      }
      if (ring + 1 < kLast) {
        capsule.Add({corner(0, 0), corner(1, 1), corner(1, 0)},
                    {across(0, 0), across(1, 1), across(1, 0)});
      }
    }
  }
  return capsule;
}

ShadedMesh MakeBand(const Vector3d& from, const Vector3d& to, double radius, const Vector3d& back) {
  const Vector3d along = (to - from) - (to - from).dot(back) * back;
  const Vector3d u = along.norm() > 0 ? Vector3d(along.normalized()) : back.unitOrthogonal();
  const Vector3d v = back.cross(u);
  std::vector<Vector3d> outline;
  for (const bool far_end : {false, true}) {
    for (int i = 0; i <= kBandSides; ++i) {
      const double turn =
          std::numbers::pi * ((far_end ? -0.5 : 0.5) + static_cast<double>(i) / kBandSides);
      outline.push_back((far_end ? to : from) +
                        radius * (std::cos(turn) * u + std::sin(turn) * v + back));
    }
  }
  // Only full-width triangles run along the band: in narrow ones, depth is not exact enough.
  ShadedMesh band;
  const auto add = [&](int a, int b, int c) {
    band.Add({outline[a], outline[b], outline[c]}, {back, back, back});
  };
  constexpr int kFar = kBandSides + 1;  // the first corner at the far end
  add(0, kBandSides, kFar);
  add(0, kFar, kFar + kBandSides);
  for (const int first : {0, kFar}) {
    for (int i = 2; i <= kBandSides; ++i) add(first, first + i - 1, first + i);
  }
  return band;
}

namespace {

/// A ray with its inverse direction.
struct Ray {
  Ray(const Vector3d& origin, const Vector3d& direction, double skip)
      : origin(origin), direction(direction), inverse(direction.cwiseInverse()), from(skip) {}

  const Vector3d& origin;
  const Vector3d& direction;
  const Vector3d inverse;
  double from;

  [[nodiscard]] bool Meets(const Eigen::AlignedBox3d& box, double to) const {
    double near = from;
    for (int axis = 0; axis < 3; ++axis) {
      if (direction[axis] ==
          0) {  // avoids zero times infinity for an origin in the plane of a side
        if (origin[axis] < box.min()[axis] || origin[axis] > box.max()[axis]) return false;
        continue;
      }
      const double a = (box.min()[axis] - origin[axis]) * inverse[axis];
      const double b = (box.max()[axis] - origin[axis]) * inverse[axis];
      near = std::max(near, std::min(a, b));
      to = std::min(to, std::max(a, b));
    }
    return near <= to;
  }

  /// Return the distance to a triangle; infinity without intersection.
  [[nodiscard]] double DistanceTo(const std::array<Vector3d, 3>& triangle) const {
    // Möller and Trumbore 1997.
    const auto& [a, b, c] = triangle;
    const Vector3d u = b - a;
    const Vector3d v = c - a;
    const Vector3d p = direction.cross(v);
    const double determinant = u.dot(p);
    const Vector3d s = origin - a;
    const double alpha = s.dot(p) / determinant;
    const Vector3d q = s.cross(u);
    const double beta = direction.dot(q) / determinant;
    const double distance = v.dot(q) / determinant;
    const bool met = determinant != 0 && alpha >= 0 && beta >= 0 && alpha + beta <= 1;
    return met && distance > from ? distance : std::numeric_limits<double>::infinity();
  }
};

/// Visit the triangles that a ray hits.
/// @param take  function of the distance to a triangle. It returns the distance up to which further
///              triangles count; a negative value ends the visit.
template <class Take>
void VisitHits(const object::TriangleTree& tree, const Ray& ray, const Take& take) {
  double to = std::numeric_limits<double>::infinity();
  tree.Visit([&](const Eigen::AlignedBox3d& box) { return ray.Meets(box, to); },
             [&](const object::Corners& triangle) {
               const double distance = ray.DistanceTo(triangle);
               if (distance < to) to = take(distance);
               return to >= 0;
             });
}

}  // namespace

double RayTree::Distance(const Vector3d& origin, const Vector3d& direction, double skip) const {
  double nearest = std::numeric_limits<double>::infinity();
  VisitHits(tree_, Ray(origin, direction, skip),
            [&nearest](double distance) { return nearest = distance; });
  return nearest;
}

int RayTree::CountHits(const Vector3d& origin, const Vector3d& direction, double skip,
                       int most) const {
  int hits = 0;
  VisitHits(tree_, Ray(origin, direction, skip),
            [&](double) { return ++hits < most ? std::numeric_limits<double>::infinity() : -1; });
  return hits;
}

bool IsHit(const std::vector<PlacedRays>& surfaces, const Eigen::Vector3d& origin,
           const Eigen::Vector3d& direction, double skip) {
  return std::ranges::any_of(surfaces, [&](const PlacedRays& surface) {
    const auto& [rays, to_rays] = surface;
    return rays->CountHits(to_rays * origin, to_rays.linear() * direction, skip, 1) > 0;
  });
}

}  // namespace regrasp::render
