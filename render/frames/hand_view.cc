#include "render/frames/hand_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "planner/base/number.h"
#include "render/frames/mesh_detail.h"
#include "render/frames/visible_part.h"
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

/// Largest angle between a position of the eye relative to a link and the one that represents it.
constexpr double kEyeAngle = Radians(6);
/// Size of the pixels that decide which triangles are visible, per size of omitted details.
constexpr double kSeenDetail = 0.5;

/// Radius of a window around the middle of fingertip and cone, in diameters.
constexpr double kWindow = 0.16;
/// Hidden share of a finger above which its window is fully clear.
constexpr double kMostHidden = 0.5;
constexpr double kHandRaySkip = 1e-4;

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
  const WeldedMesh welded = Weld(mesh);
  std::vector<int> parts(welded.vertices.size());
  std::iota(parts.begin(), parts.end(), 0);
  const auto part_of = [&parts](int i) {
    while (parts[i] != i) i = parts[i] = parts[parts[i]];
    return i;
  };
  for (const auto& [a, b, c] : welded.triangles) {
    parts[part_of(a)] = part_of(b);
    parts[part_of(b)] = part_of(c);
  }
  // Volumes relative to a point in the middle, so that a part with holes has about the volume that
  // it encloses.
  std::vector<Vector3d> sums(parts.size(), Vector3d::Zero());
  std::vector<int> sizes(parts.size(), 0);
  const auto part_of_triangle = [&](std::size_t t) { return part_of(welded.triangles[t][0]); };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    sums[part_of_triangle(t)] += (a + b + c) / 3;
    ++sizes[part_of_triangle(t)];
  }
  std::vector<double> volumes(parts.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const int part = part_of_triangle(t);
    const Vector3d middle = sums[part] / sizes[part];
    volumes[part] += (a - middle).cross(b - middle).dot(c - middle);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (volumes[part_of_triangle(t)] >= 0) continue;
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    std::swap(mesh.normals[t][1], mesh.normals[t][2]);
    for (Vector3d& normal : mesh.normals[t]) normal = -normal;
  }
}

/// Return the farthest corners in many directions.
std::vector<Vector3d> FarthestCorners(const ShadedMesh& mesh) {
  constexpr int kDirections = 96;
  const std::vector<Vector3d> corners = Weld(mesh).vertices;
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

std::vector<ShadedMesh> MakeLinkMeshes(const HandView& hand, const NormalizedFrame& frame,
                                       double tolerance) {
  std::vector<ShadedMesh> meshes;
  std::vector<ShadedMesh> reduced;
  for (const HandLinkView& view : hand) {
    // The links of several fingers are often equal.
    const auto equal = std::ranges::find_if(hand, [&](const HandLinkView& other) {
      return other.mesh.triangles == view.mesh.triangles && other.mesh.normals == view.mesh.normals;
    });
    if (equal < hand.begin() + std::ssize(reduced)) {
      reduced.push_back(reduced[equal - hand.begin()]);
    } else {
      ShadedMesh mesh = Normalized(view.mesh, frame);
      if (tolerance > 0) mesh = ReduceDetail(mesh, tolerance);
      OrientOutward(mesh);
      reduced.push_back(std::move(mesh));
    }
    ShadedMesh mesh = reduced.back();
    if (view.link.joints > 0) Grow(kHair * view.link.joints, mesh);
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

std::vector<ShadedMesh> MakeHandMeshes(const HandView& hand, const NormalizedFrame& frame,
                                       double tolerance,
                                       std::span<const std::vector<Vector3d>> eyes) {
  std::vector<ShadedMesh> meshes;
  std::optional<OffscreenContext> context;
  if (!eyes.empty()) context.emplace(kVisibleSide, kVisibleSide);
  for (ShadedMesh& mesh : MakeLinkMeshes(hand, frame, tolerance)) {
    const std::size_t link = meshes.size() / 2;
    ShadedMesh shell = MakeShell(mesh, kHandRim);
    if (!eyes.empty()) {
      Eigen::AlignedBox3d box;
      for (const auto& corners : mesh.triangles) {
        for (const Vector3d& p : corners) box.extend(p);
      }
      const std::vector<Vector3d> chosen = ChooseEyes(eyes[link], box.center(), kEyeAngle);
      ShelledMesh seen = VisiblePart({mesh, shell}, chosen, kSeenDetail * tolerance, *context);
      shell = std::move(seen.shell);
      mesh = std::move(seen.mesh);
    }
    meshes.push_back(std::move(shell));
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
    return IsInContact(snapshot, i) ? Mixed(kHandColor, FingerColor(link.finger), kTint)
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

bool HandFigure::IsInContact(const plan::Snapshot& snapshot, std::size_t link) const {
  if (!is_fingertip_[link]) return false;
  const auto finger =
      std::ranges::find(snapshot.fingers, links_[link].finger, &plan::FingerState::finger);
  return finger != snapshot.fingers.end() && Touches(*finger);
}

std::vector<Shape> HandFigure::Rims(const plan::Snapshot& snapshot, bool in_contact,
                                    int first_mesh) const {
  std::vector<Shape> shapes;
  for (std::size_t i = 0; i < snapshot.links_W.size(); ++i) {
    if (IsInContact(snapshot, i) != in_contact) continue;
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
