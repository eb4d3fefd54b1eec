#include "render/frames/hand_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "render/picture/image.h"

namespace regrasp::render {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr Color kHandColor = {222, 214, 203};
constexpr Color kHandOutline = {96, 92, 90};
/// Share of the finger's colour in a fingertip in contact, and of red in a faulty link.
constexpr double kTint = 0.42;
constexpr double kFaultTint = 0.72;
/// Opacity of a hand.
constexpr double kHandOpacity = 0.9;
/// Width of its outline, in diameters.
constexpr double kHandRim = 0.006;
/// Offset of a link's surface per preceding joint, in diameters. Without it two links with the same
/// sphere at a joint would flicker.
constexpr double kHair = 1.5e-3;

/// Radius of a window around the middle of fingertip and cone, in diameters.
constexpr double kWindow = 0.16;
/// Hidden share of a finger above which its window is fully clear.
constexpr double kMostHidden = 0.5;
constexpr double kHandRaySkip = 1e-4;
/// Length of a sum of unit normals, weighted by angles in radians, that counts as zero.
constexpr double kLeastMean = 1e-3;

Color Mixed(Color a, Color b, double share) {
  const auto mix = [share](int x, int y) {
    return static_cast<unsigned char>(std::lround((1 - share) * x + share * y));
  };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

ShadedMesh Normalized(ShadedMesh mesh, const NormalizedFrame& frame) {
  for (auto& corners : mesh.triangles) {
    for (Vector3d& p : corners) p /= frame.diameter_m;
  }
  return mesh;
}

/// Flip connected parts whose triangles are oriented inwards: their shells would hide them.
void OrientOutward(ShadedMesh& mesh) {
  const int count = static_cast<int>(mesh.triangles.size());
  std::vector<int> parts(count);
  std::iota(parts.begin(), parts.end(), 0);
  const auto part_of = [&parts](int i) {
    while (parts[i] != i) i = parts[i] = parts[parts[i]];
    return i;
  };
  std::map<std::array<double, 3>, int> owner;  // first triangle of each corner
  for (int i = 0; i < count; ++i) {
    for (const Vector3d& p : mesh.triangles[i]) {
      const auto [found, is_new] = owner.try_emplace({p.x(), p.y(), p.z()}, i);
      if (!is_new) parts[part_of(i)] = part_of(found->second);
    }
  }
  // Volumes relative to a point in the middle, so that a part with holes has about the volume that
  // it encloses.
  std::vector<Vector3d> sums(count, Vector3d::Zero());
  std::vector<int> sizes(count, 0);
  for (int i = 0; i < count; ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    sums[part_of(i)] += (a + b + c) / 3;
    ++sizes[part_of(i)];
  }
  std::vector<double> volumes(count, 0);
  for (int i = 0; i < count; ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const int part = part_of(i);
    const Vector3d middle = sums[part] / sizes[part];
    volumes[part] += (a - middle).cross(b - middle).dot(c - middle);
  }
  for (int i = 0; i < count; ++i) {
    if (volumes[part_of(i)] >= 0) continue;
    std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    std::swap(mesh.normals[i][1], mesh.normals[i][2]);
    for (Vector3d& normal : mesh.normals[i]) normal = -normal;
  }
}

/// Offset a surface. Each corner moves along the mean normal of its triangles, weighted by their
/// angles (Thürmer and Wüthrich 1998), so that the surface has no gaps at creases.
void Grow(double by, ShadedMesh& mesh) {
  std::map<std::array<double, 3>, Vector3d> sums;
  for (const auto& corners : mesh.triangles) {
    const Vector3d across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    if (across.isZero(0)) continue;
    for (int k = 0; k < 3; ++k) {
      const Vector3d u = corners[(k + 1) % 3] - corners[k], v = corners[(k + 2) % 3] - corners[k];
      const double angle = std::atan2(u.cross(v).norm(), u.dot(v));
      const Vector3d& p = corners[k];
      const auto [sum, is_new] = sums.try_emplace({p.x(), p.y(), p.z()}, Vector3d::Zero());
      sum->second += angle * across.normalized();
    }
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      Vector3d& p = mesh.triangles[i][k];
      const auto sum = sums.find({p.x(), p.y(), p.z()});
      // The mean of both sides of a sheet has no direction.
      const bool has_mean = sum != sums.end() && sum->second.norm() > kLeastMean;
      p += by * (has_mean ? Vector3d(sum->second.normalized()) : mesh.normals[i][k]);
    }
  }
}

/// Return a slightly enlarged mesh with inward orientation. The mesh hides all of it but the rim.
ShadedMesh MakeShell(ShadedMesh mesh) {
  Grow(kHandRim, mesh);
  return TurnInsideOut(std::move(mesh));
}

/// Return the different corners of a mesh, in the order in which they first occur.
std::vector<Vector3d> CornersOf(const ShadedMesh& mesh) {
  std::set<std::array<double, 3>> known;
  std::vector<Vector3d> corners;
  for (const auto& triangle : mesh.triangles) {
    for (const Vector3d& p : triangle) {
      if (known.insert({p.x(), p.y(), p.z()}).second) corners.push_back(p);
    }
  }
  return corners;
}

/// Return the farthest corners in many directions.
std::vector<Vector3d> FarthestCorners(const ShadedMesh& mesh) {
  constexpr int kDirections = 96;
  const std::vector<Vector3d> corners = CornersOf(mesh);
  std::vector<Vector3d> farthest;
  for (int i = 0; i < kDirections; ++i) {
    // Golden-angle spiral: evenly distributed over the sphere.
    const double z = 1 - (2.0 * i + 1) / kDirections;
    const double turn = std::numbers::pi * (3 - std::sqrt(5)) * i;
    const Vector3d direction(std::sqrt(1 - z * z) * std::cos(turn),
                             std::sqrt(1 - z * z) * std::sin(turn), z);
    const Vector3d* best = nullptr;
    for (const Vector3d& p : corners) {
      if (best == nullptr || p.dot(direction) > best->dot(direction)) best = &p;
    }
    if (best != nullptr) farthest.push_back(*best);
  }
  return farthest;
}

bool Touches(const plan::FingerState& finger) {
  return finger.role != plan::FingerRole::kFree && finger.role != plan::FingerRole::kReleased;
}

}  // namespace

std::vector<ShadedMesh> MakeHandMeshes(const HandView& hand, const NormalizedFrame& frame) {
  std::vector<ShadedMesh> meshes;
  for (const HandLinkView& view : hand) {
    ShadedMesh mesh = Normalized(view.mesh, frame);
    OrientOutward(mesh);
    Grow(kHair * view.link.joints, mesh);
    meshes.push_back(MakeShell(mesh));
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

HandFigure::HandFigure(const HandView& hand, const NormalizedFrame& frame) : frame_(frame) {
  for (const HandLinkView& view : hand) {
    links_.push_back(view.link);
    is_fingertip_.push_back(view.is_fingertip);
    const ShadedMesh mesh = Normalized(view.mesh, frame);
    rays_.emplace_back(mesh);
    bounds_.push_back(FarthestCorners(mesh));
  }
}

Isometry3d HandFigure::PoseOf(const plan::Snapshot& snapshot, std::size_t link) const {
  Isometry3d pose = snapshot.links_W[link];
  pose.translation() = frame_.FromWorld(pose.translation());
  return pose;
}

std::vector<Shape> HandFigure::Shapes(const plan::Snapshot& snapshot,
                                      std::span<const plan::HandLink> at_fault,
                                      int first_mesh) const {
  const auto color_of = [&](std::size_t i) {
    const plan::HandLink& link = links_[i];
    if (std::ranges::find(at_fault, link) != at_fault.end()) {
      return Mixed(kHandColor, kFaultRed, kFaultTint);
    }
    const auto finger =
        std::ranges::find(snapshot.fingers, link.finger, &plan::FingerState::finger);
    const bool touches = finger != snapshot.fingers.end() && Touches(*finger);
    return touches && is_fingertip_[i] ? Mixed(kHandColor, FingerColor(link.finger), kTint)
                                       : kHandColor;
  };
  std::vector<Shape> shapes;
  for (std::size_t i = 0; i < snapshot.links_W.size(); ++i) {
    const Isometry3d pose = PoseOf(snapshot, i);
    const int mesh = first_mesh + 2 * static_cast<int>(i);
    shapes.push_back({MeshInstance{mesh + 1, pose}, color_of(i), kHandOpacity});
  }
  return shapes;
}

std::vector<Shape> HandFigure::Rims(const plan::Snapshot& snapshot, int first_mesh) const {
  std::vector<Shape> shapes;
  for (std::size_t i = 0; i < snapshot.links_W.size(); ++i) {
    const int mesh = first_mesh + 2 * static_cast<int>(i);
    shapes.push_back({MeshInstance{mesh, PoseOf(snapshot, i)}, kHandOutline, kHandOpacity});
  }
  return shapes;
}

std::vector<Vector3d> HandFigure::Bounds(const plan::Snapshot& snapshot) const {
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < snapshot.links_W.size(); ++i) {
    const Isometry3d pose = PoseOf(snapshot, i);
    for (const Vector3d& p : bounds_[i]) points.push_back(pose * p);
  }
  return points;
}

std::vector<PlacedRays> HandFigure::Rays(const plan::Snapshot& snapshot) const {
  std::vector<PlacedRays> placed;
  for (std::size_t i = 0; i < snapshot.links_W.size(); ++i) {
    placed.push_back({&rays_[i], PoseOf(snapshot, i).inverse()});
  }
  return placed;
}

std::vector<Window> HandFigure::Windows(const plan::Snapshot& snapshot,
                                        std::span<const FingerGlyph> fingers,
                                        const Camera& camera) const {
  const std::vector<PlacedRays> links = Rays(snapshot);
  std::vector<Window> windows;
  for (const FingerGlyph& glyph : fingers) {
    if (glyph.role == plan::FingerRole::kReleased) continue;
    constexpr std::array<double, 5> kPlaces = {-0.9, -0.6, -0.3, 0, 0.25};
    int hidden = 0;
    for (const double place : kPlaces) {
      const Vector3d p = glyph.contact + place * kConeLength * glyph.outward;
      if (IsHit(links, p, camera.ToEye(p), kHandRaySkip)) ++hidden;
    }
    if (hidden == 0) continue;
    const double share = static_cast<double>(hidden) / kPlaces.size();
    const Vector3d middle = glyph.contact - 0.35 * kConeLength * glyph.outward;
    windows.push_back({camera.Project(middle), kWindow * camera.PixelsPerUnit(middle),
                       std::min(1.0, share / kMostHidden)});
  }
  return windows;
}

}  // namespace regrasp::render
