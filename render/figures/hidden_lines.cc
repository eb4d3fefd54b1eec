#include "render/figures/hidden_lines.h"

#include <cmath>

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

/// Nearer than this a surface is the one that a point lies on.
constexpr double kOnSurface = 2e-3;
constexpr double kPlaceTolerance = 1e-5;  ///< of a step

class LineSplitter {
 public:
  LineSplitter(const RayTree& surface, const LineSegment& line, const Vector3d& back)
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

  const RayTree& surface_;
  const LineSegment& line_;
  const Vector3d& back_;
};

}  // namespace

bool IsHidden(const RayTree& surface, const Vector3d& point, const Vector3d& back) {
  return surface.CountHits(point, back, kOnSurface, 1) > 0;
}

LineParts SplitByVisibility(const RayTree& surface, std::span<const LineSegment> lines,
                            const Vector3d& back) {
  LineParts parts;
  for (const LineSegment& line : lines) {
    LineSplitter(surface, line, back).Split(parts);
  }
  return parts;
}

}  // namespace regrasp::render
