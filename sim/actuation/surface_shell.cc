#include "sim/actuation/surface_shell.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/collision/convex_shape.h"
#include "planner/collision/surface_tree.h"

namespace regrasp::sim {

namespace {

using Eigen::Vector3d;

/// Number of halvings of the depth; a piece that still crosses the surface is kept.
constexpr int kDepthHalvings = 8;
/// Size of a piece in tests, relative to the piece: pieces touch their neighbours.
constexpr double kShrunk = 0.99;

/// Return a piece about its centroid, in metres of the solid's file.
collision::ConvexShape Shrunk(const ShellPiece& piece) {
  const Vector3d centre = (piece[0] + piece[1] + piece[2] + piece[3]) / 4;
  collision::ConvexShape shape;
  for (const Vector3d& corner : piece) shape.points.push_back(centre + kShrunk * (corner - centre));
  return shape;
}

double VolumeOf(const ShellPiece& piece) {
  const Vector3d base = (piece[1] - piece[0]).cross(piece[2] - piece[0]);
  return std::abs(base.dot(piece[3] - piece[0])) / 6;
}

/// Return a piece with the deepest apex that does not cross the surface.
ShellPiece MakePiece(const std::array<Vector3d, 3>& triangle,
                     const collision::SurfaceTree& surface) {
  const auto& [a, b, c] = triangle;
  const Vector3d centroid = (a + b + c) / 3;
  const Vector3d inward = -(b - a).cross(c - a).normalized();
  double depth = kShellDepth;
  for (int halving = 0; halving < kDepthHalvings; ++halving, depth /= 2) {
    if (surface.IsApart(Shrunk({a, b, c, centroid + depth * inward}), 0)) break;
  }
  return {a, b, c, centroid + depth * inward};
}

}  // namespace

bool IsConvex(const object::Polyhedron& solid) {
  for (FaceIndex face(0); face < solid.face_count(); ++face) {
    const auto& borders = solid.BordersOf(face);
    if (!std::ranges::all_of(borders, &object::FaceBorder::convex)) return false;
  }
  return true;
}

std::vector<ShellPiece> SurfaceShell(const object::Polyhedron& solid, double scale) {
  const collision::SurfaceTree surface(solid, scale);
  const Vector3d centroid = scale * solid.mass_properties().centroid;
  std::vector<ShellPiece> pieces;
  for (const std::array<int, 3>& corners : solid.triangles()) {
    const auto at = [&](int corner) -> Vector3d { return scale * solid.vertices()[corner]; };
    ShellPiece piece = MakePiece({at(corners[0]), at(corners[1]), at(corners[2])}, surface);
    if (VolumeOf(piece) < kLeastPiece) continue;
    for (Vector3d& corner : piece) corner -= centroid;
    pieces.push_back(piece);
  }
  return pieces;
}

}  // namespace regrasp::sim
