#include "render/figures/hidden_lines.h"

#include <Eigen/Geometry>
#include <cmath>

#include "render/frames/camera.h"

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

/// Nearer than this a surface is the one that a point lies on.
constexpr double kOnSurface = 2e-3;
constexpr double kPlaceTolerance = 1e-5;  ///< of a step

/// Points across the line of sight.
class FlatBox {
 public:
  explicit FlatBox(const Eigen::Matrix3d& axes) : axes_(axes) {}
  FlatBox& Extend(const Vector3d& p) {
    box_.extend(Eigen::Vector2d((axes_.transpose() * p).head<2>()));
    return *this;
  }
  [[nodiscard]] bool Meets(const FlatBox& other) const { return box_.intersects(other.box_); }

 private:
  const Eigen::Matrix3d& axes_;
  Eigen::AlignedBox2d box_;
};

/// The triangles that may stand before a line.
FacetMesh TrianglesBefore(const FacetMesh& surface, const LineSegment& line,
                          const Eigen::Matrix3d& axes) {
  FacetMesh before;
  const FlatBox here = FlatBox(axes).Extend(line[0]).Extend(line[1]);
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto& [a, b, c] = surface.triangles[i];
    if (!FlatBox(axes).Extend(a).Extend(b).Extend(c).Meets(here)) continue;
    before.Add(surface.triangles[i], surface.normals[i]);
  }
  return before;
}

class LineSplitter {
 public:
  LineSplitter(const FacetMesh& surface, const LineSegment& line, const Vector3d& back)
      : surface_(surface), line_(line), back_(back) {}

  void Split(LineParts& parts) const {
    const int steps =
        std::max(1, static_cast<int>(std::ceil((line_[1] - line_[0]).norm() / kVisibilityStep)));
    double begin = 0;
    // The ends lie on other lines' corners: the middle of a step tells more.
    bool hidden = HiddenAt(0.5 / steps);
    for (int i = 1; i < steps; ++i) {
      const double from = (i - 0.5) / steps;
      const double to = (i + 0.5) / steps;
      if (HiddenAt(to) == hidden) continue;
      const double change = FindChange(from, to, hidden);
      Add(begin, change, hidden, parts);
      begin = change;
      hidden = !hidden;
    }
    Add(begin, 1, hidden, parts);
  }

 private:
  [[nodiscard]] Vector3d At(double t) const { return line_[0] + t * (line_[1] - line_[0]); }
  [[nodiscard]] bool HiddenAt(double t) const { return IsHidden(surface_, At(t), back_); }

  [[nodiscard]] double FindChange(double from, double to, bool hidden) const {
    const double enough = kPlaceTolerance * (to - from);
    while (to - from > enough) {
      const double middle = (from + to) / 2;
      (HiddenAt(middle) == hidden ? from : to) = middle;
    }
    return to;
  }

  void Add(double from, double to, bool hidden, LineParts& parts) const {
    (hidden ? parts.hidden : parts.visible).push_back({At(from), At(to)});
  }

  const FacetMesh& surface_;
  const LineSegment& line_;
  const Vector3d& back_;
};

}  // namespace

bool IsHidden(const FacetMesh& surface, const Vector3d& point, const Vector3d& back) {
  return std::isfinite(RayDistance(surface, point, back, kOnSurface));
}

LineParts SplitByVisibility(const FacetMesh& surface, std::span<const LineSegment> lines,
                            const Vector3d& back) {
  const Eigen::Matrix3d axes = CameraAxes(back);
  LineParts parts;
  for (const LineSegment& line : lines) {
    LineSplitter(TrianglesBefore(surface, line, axes), line, back).Split(parts);
  }
  return parts;
}

}  // namespace regrasp::render
