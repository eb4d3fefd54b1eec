#include "render/frames/visible_part.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "render/frames/camera.h"
#include "render/frames/shape_painter.h"

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

constexpr int kSmallestSide = 16;  ///< smallest side of an image, pixels

/// Return a mesh relative to `centre` whose triangles have the colours first, first + 1, ….
ShadedMesh Numbered(ShadedMesh mesh, const Vector3d& centre, std::size_t first) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (Vector3d& p : mesh.triangles[t]) p -= centre;
    const std::size_t number = first + t;
    const auto byte = [number](int shift) {
      return static_cast<unsigned char>(number >> shift & 0xff);
    };
    const Color color = {byte(0), byte(8), byte(16)};
    mesh.colors.push_back({color, color, color});
  }
  return mesh;
}

ShadedMesh SeenPart(const ShadedMesh& mesh, std::span<const bool> is_seen) {
  ShadedMesh part;
  for (std::size_t t = 0; t < is_seen.size(); ++t) {
    if (is_seen[t]) part.Add(mesh.triangles[t], mesh.normals[t]);
  }
  return part;
}

/// Return the triangles of a mesh with at least one corner that occurs in a seen triangle.
ShadedMesh SeenPartAndNeighbours(const ShadedMesh& mesh, std::span<const bool> is_seen) {
  const WeldedMesh corners = Weld(mesh);
  std::vector<bool> is_near(corners.vertices.size(), false);
  for (std::size_t t = 0; t < is_seen.size(); ++t) {
    if (!is_seen[t]) continue;
    for (const int vertex : corners.triangles[t]) is_near[vertex] = true;
  }
  ShadedMesh part;
  for (std::size_t t = 0; t < is_seen.size(); ++t) {
    const bool is_kept =
        std::ranges::any_of(corners.triangles[t], [&](int vertex) { return is_near[vertex]; });
    if (is_kept) part.Add(mesh.triangles[t], mesh.normals[t]);
  }
  return part;
}

}  // namespace

std::vector<Vector3d> ChooseEyes(std::span<const Vector3d> eyes, const Vector3d& centre,
                                 double angle) {
  std::vector<Vector3d> chosen, directions;
  const double least = std::cos(angle);
  for (const Vector3d& eye : eyes) {
    const Vector3d direction = (eye - centre).normalized();
    const bool is_represented = std::ranges::any_of(
        directions, [&](const Vector3d& known) { return known.dot(direction) >= least; });
    if (is_represented) continue;
    chosen.push_back(eye);
    directions.push_back(direction);
  }
  return chosen;
}

ShelledMesh VisiblePart(const ShelledMesh& shelled, std::span<const Vector3d> eyes, double pixel,
                        OffscreenContext& context) {
  const std::size_t count = shelled.mesh.triangles.size();
  if (count == 0 || eyes.empty()) return {};
  Eigen::AlignedBox3d box;
  for (const auto& corners : shelled.shell.triangles) {
    for (const Vector3d& p : corners) box.extend(p);
  }
  const Vector3d centre = box.center();
  const double radius = box.diagonal().norm() / 2;
  const int side =
      static_cast<int>(std::clamp<double>(2 * radius / pixel, kSmallestSide, kVisibleSide));
  const VertexArrays mesh(Numbered(shelled.mesh, centre, 1), /*shared=*/false);
  const VertexArrays shell(Numbered(shelled.shell, centre, 1 + count), /*shared=*/false);
  // Color 0 is the background.
  const auto is_seen = std::make_unique<bool[]>(1 + 2 * count);
  std::vector<unsigned char> pixels(std::size_t{4} * side * side);
  const OffscreenContext::Use use(context);
  InitState();
  gl().Disable(GL_LIGHTING);
  gl().ClearColor(0, 0, 0, 0);
  gl().Viewport(0, 0, side, side);
  for (const Vector3d& eye : eyes) {
    const Vector3d back = eye - centre;
    const double slope = radius / std::sqrt(std::max(0.0, back.squaredNorm() - radius * radius));
    SetCamera({back, CameraAxes(back.normalized()), Projection::kPerspective, slope, side, side},
              {0, side, side});
    gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    mesh.Draw();
    shell.Draw();
    ReadPixels({0, 0, side, side}, side, pixels.data());
    for (auto seen = pixels.begin(); seen != pixels.end(); seen += 4) {
      is_seen[seen[0] | seen[1] << 8 | seen[2] << 16] = true;
    }
  }
  return {SeenPartAndNeighbours(shelled.mesh, {&is_seen[1], count}),
          SeenPart(shelled.shell, {&is_seen[1 + count], count})};
}

}  // namespace regrasp::render
