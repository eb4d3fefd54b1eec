#include "render/figures/scan_outline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

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

/// Samples of a surface in a panel.
class PanelSamples {
 public:
  PanelSamples(const Eigen::AlignedBox2d& box, const PanelCamera& camera)
      : camera_(camera),
        per_point_(std::min(kSamplesPerPoint, kMostSamples / box.sizes().maxCoeff())),
        corner_(box.min() - Vector2d::Constant(kBorder / per_point_)),
        buffer_(CountAlong(box.sizes().x()), CountAlong(box.sizes().y())) {}

  [[nodiscard]] double per_point() const { return per_point_; }
  [[nodiscard]] double per_unit() const { return per_point_ * camera_.scale; }
  [[nodiscard]] SurfaceBuffer& buffer() { return buffer_; }

  void Add(const ShadedMesh& surface, int label) {
    const auto place = [&](const Vector3d& p) {
      const Vector2d at = per_point_ * (camera_(p) - corner_);
      return Vector3d(at.x(), at.y(), per_unit() * camera_.back().dot(p));
    };
    Eigen::Matrix3d turn = camera_.axes.transpose();
    turn.row(1) *= -1;
    buffer_.Add(surface, label, place, turn);
  }
  /// Return the outlines of the areas of samples that a predicate selects, in points.
  template <class IsInside>
  [[nodiscard]] std::vector<Polyline> Areas(const IsInside& is_inside) const {
    return InPanel(
        OutlineOf(buffer_.width(), buffer_.height(), kSmallestArea * per_point_, is_inside));
  }
  [[nodiscard]] std::vector<Polyline> InPanel(const std::vector<Polyline>& lines) const {
    std::vector<Polyline> placed;
    for (Polyline line : lines) {
      for (Vector2d& p : line) p = corner_ + p / per_point_;
      placed.push_back(Simplified(line, kTolerance));
    }
    return placed;
  }

 private:
  [[nodiscard]] int CountAlong(double points) const {
    return static_cast<int>(std::ceil(per_point_ * points)) + 2 * kBorder;
  }

  const PanelCamera& camera_;
  double per_point_;
  Vector2d corner_;
  SurfaceBuffer buffer_;
};

Eigen::AlignedBox2d BoxOf(const ShadedMesh& surface, const PanelCamera& camera) {
  Eigen::AlignedBox2d box;
  for (const auto& corners : surface.triangles) {
    for (const Vector3d& p : corners) box.extend(camera(p));
  }
  return box;
}

}  // namespace

ScanOutline TraceScan(const ShadedMesh& surface, const PanelCamera& camera) {
  const Eigen::AlignedBox2d box = BoxOf(surface, camera);
  if (box.isEmpty()) return {};
  PanelSamples samples(box, camera);
  samples.Add(surface, 0);
  const double step = kDepthStep * samples.per_unit();
  SurfaceBuffer& buffer = samples.buffer();
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
  outline.areas = samples.Areas(is_inside);
  outline.lines = samples.InPanel(sides.Trace(kShortestOutline * samples.per_point()));
  outline.lines.insert(outline.lines.end(), outline.areas.begin(), outline.areas.end());
  return outline;
}

std::vector<TintedArea> TraceTints(const ShadedMesh& surface, const PanelCamera& camera) {
  const Eigen::AlignedBox2d box = BoxOf(surface, camera);
  if (box.isEmpty()) return {};
  std::map<std::array<unsigned char, 3>, ShadedMesh> by_color;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const Color& color = surface.colors[i][0];
    by_color[{color.r, color.g, color.b}].Add(surface.triangles[i], surface.normals[i]);
  }
  PanelSamples samples(box, camera);
  int label = 0;
  for (const auto& [color, mesh] : by_color) samples.Add(mesh, label++);
  std::vector<TintedArea> areas;
  label = 0;
  for (const auto& [color, mesh] : by_color) {
    areas.push_back({{color[0], color[1], color[2]}, samples.Areas([&](int x, int y) {
                       return samples.buffer().LabelAt(x, y) == label;
                     })});
    ++label;
  }
  return areas;
}

}  // namespace regrasp::render
