#include "render/figures/scan_outline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "render/figures/surface_buffer.h"

namespace regrasp::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Samples per point, and the largest number of samples along a side of the image.
constexpr double kSamplesPerPoint = 8;
constexpr double kMostSamples = 2400;
/// Samples around the surface, whose steps of depth compare with samples outside.
constexpr int kBorder = 4;
/// Width of the rim of the surface, which has no inner lines, samples.
constexpr int kRim = 3;
/// Step of depth at an outline, in diameters.
constexpr double kDepthStep = 0.015;
/// Length of the shortest outline and size of the smallest area, points.
constexpr double kShortestOutline = 7;
constexpr double kSmallestArea = 1.5;
/// Tolerance of the lines, points.
constexpr double kTolerance = 0.15;

std::vector<Polyline> InPanel(const std::vector<Polyline>& lines, double per_point,
                              const Vector2d& corner) {
  std::vector<Polyline> placed;
  for (Polyline line : lines) {
    for (Vector2d& p : line) p = corner + p / per_point;
    placed.push_back(Simplified(line, kTolerance));
  }
  return placed;
}

}  // namespace

ScanOutline TraceScan(const ShadedMesh& surface, const PanelCamera& camera) {
  Eigen::AlignedBox2d box;
  for (const auto& corners : surface.triangles) {
    for (const Vector3d& p : corners) box.extend(camera(p));
  }
  if (box.isEmpty()) return {};
  const double per_point = std::min(kSamplesPerPoint, kMostSamples / box.sizes().maxCoeff());
  const Vector2d corner = box.min() - Vector2d::Constant(kBorder / per_point);
  const auto samples = [&](double points) {
    return static_cast<int>(std::ceil(per_point * points)) + 2 * kBorder;
  };
  SurfaceBuffer buffer(samples(box.sizes().x()), samples(box.sizes().y()));
  const double per_unit = per_point * camera.scale;
  const auto place = [&](const Vector3d& p) {
    const Vector2d at = per_point * (camera(p) - corner);
    return Vector3d(at.x(), at.y(), per_unit * camera.back().dot(p));
  };
  Eigen::Matrix3d turn = camera.axes.transpose();
  turn.row(1) *= -1;
  buffer.Add(surface, 0, place, turn);
  const double step = kDepthStep * per_unit;
  buffer.RemoveSpecks(step);
  const auto is_inside = [&](int x, int y) {
    return buffer.LabelAt(x, y) != SurfaceBuffer::kNothing;
  };
  // Near the rim a surface is so steep that its samples have steps, too.
  const auto is_at_rim = [&](int x, int y) {
    return !is_inside(x - kRim, y) || !is_inside(x + kRim, y) || !is_inside(x, y - kRim) ||
           !is_inside(x, y + kRim);
  };
  SampleSides sides(buffer.width(), buffer.height());
  sides.AddBetween([&](int x, int y, int x2, int y2) {
    return !is_at_rim(x, y) && !is_at_rim(x2, y2) && IsOutline(buffer, step, x, y, x2, y2);
  });
  ScanOutline outline;
  outline.areas =
      InPanel(OutlineOf(buffer.width(), buffer.height(), kSmallestArea * per_point, is_inside),
              per_point, corner);
  outline.lines = InPanel(sides.Trace(kShortestOutline * per_point), per_point, corner);
  outline.lines.insert(outline.lines.end(), outline.areas.begin(), outline.areas.end());
  return outline;
}

}  // namespace regrasp::render
