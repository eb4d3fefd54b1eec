#include "render/frames/facet_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

/// Where a wedge lies above the plane of the contacts: on the prism's top, clear of it in the depth
/// buffer, and below the middle of a force arrow's surface.
constexpr double kWedgeBottom = 1.8e-3, kWedgeTop = 2.6e-3;

/// Segments of the cone's rim: its outline is within 0.1 % of a circle.
constexpr int kConeSegments = 72;

/// Around a capsule, and from its equator to its pole; around the end of a band.
constexpr int kCapsuleSides = 32;
constexpr int kCapsuleRings = 8;
constexpr int kBandSides = 6;

/// Two unit vectors that make a right-handed frame with `axis`.
std::pair<Vector3d, Vector3d> AcrossOf(const Vector3d& axis) {
  const Vector3d u = axis.unitOrthogonal();
  return {u, axis.cross(u)};
}

}  // namespace

void FacetMesh::AddFlat(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a).normalized();
  triangles.push_back({a, b, c});
  normals.push_back({normal, normal, normal});
}

FacetMesh TurnInsideOut(FacetMesh mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    std::swap(mesh.normals[i][1], mesh.normals[i][2]);
    for (Vector3d& normal : mesh.normals[i]) normal = -normal;
  }
  return mesh;
}

void FacetMesh::Add(const std::array<Vector3d, 3>& corners,
                    const std::array<Vector3d, 3>& corner_normals) {
  triangles.push_back(corners);
  normals.push_back(corner_normals);
}

FacetMesh MakeCone(double half_angle, double slant) {
  FacetMesh cone;
  const double sine = std::sin(half_angle);
  const double cosine = std::cos(half_angle);
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

FacetMesh MakeWedge(double half_angle, double slant) {
  FacetMesh wedge;
  const double x = slant * std::sin(half_angle);
  const double z = slant * std::cos(half_angle);
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

FacetMesh MakeCapsule(const Vector3d& from, const Vector3d& to, double radius) {
  const bool is_ball = (to - from).norm() == 0;
  const Vector3d axis = is_ball ? Vector3d::UnitZ() : Vector3d((to - from).normalized());
  const auto [u, v] = AcrossOf(axis);
  constexpr int kLast = 2 * kCapsuleRings + 1;
  const auto normal = [&](int ring, double side) -> Vector3d {
    const bool far_end = ring > kCapsuleRings;
    const double tilt =
        std::numbers::pi / 2 * ((far_end ? ring - 1 : ring) - kCapsuleRings) / kCapsuleRings;
    const double turn = 2 * std::numbers::pi * side / kCapsuleSides;
    return std::cos(tilt) * (std::cos(turn) * u + std::sin(turn) * v) + std::sin(tilt) * axis;
  };
  const auto point = [&](int ring, double side) -> Vector3d {
    return (ring > kCapsuleRings ? to : from) + radius * normal(ring, side);
  };
  FacetMesh capsule;
  for (int ring = 0; ring < kLast; ++ring) {
    for (int side = 0; side < kCapsuleSides; ++side) {
      const auto corner = [&](int i, int j) { return point(ring + i, side + j); };
      const auto across = [&](int i, int j) { return normal(ring + i, side + j); };
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

FacetMesh MakeBand(const Vector3d& from, const Vector3d& to, double radius, const Vector3d& back) {
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
  FacetMesh band;
  for (std::size_t i = 2; i < outline.size(); ++i) {
    band.Add({outline[0], outline[i - 1], outline[i]}, {back, back, back});
  }
  return band;
}

}  // namespace regrasp::render
