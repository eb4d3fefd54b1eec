#include "render/figures/solid_figure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "planner/plan/projection.h"
#include "render/figures/figure_page.h"
#include "render/figures/plan_figure.h"
#include "render/figures/solid_painter.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/caption.h"
#include "render/picture/image.h"

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

/// Distance within which a surface is the one that contains the point.
constexpr double kOnSurface = 2e-3;
constexpr double kPlaceTolerance = 1e-5;  ///< accuracy of a change of visibility, per step

class LineSplitter {
 public:
  LineSplitter(const RayTree& surface, const LineSegment& line, const Vector3d& back)
      : surface_(surface), line_(line), back_(back) {}

  void Split(LineParts& parts) const {
    const int steps =
        std::max(1, static_cast<int>(std::ceil((line_[1] - line_[0]).norm() / kVisibilityStep)));
    double begin = 0;
    // Samples are in the middle of steps, because ends coincide with corners of other lines.
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

using Eigen::Vector2d;

namespace {

// Lengths in points.
constexpr double kMargin = 10;               ///< margin for markers, arrow heads and numbers
constexpr double kTallestSolidPanel = 1.25;  ///< maximum height of a panel per width

}  // namespace

SolidPanels::SolidPanels(const object::Polyhedron& solid, const plan::Plan& plan,
                         const SolidFigureOptions& options)
    : frame_{plan.scale * solid.diameter(), plan.scale * solid.mass_properties().centroid},
      body_(MakeBodyShape(solid, options.body)),
      friction_angle_(plan.friction_angle) {
  const int entries = static_cast<int>(plan.steps.size()) + 1;
  for (plan::EntryIndex entry{0}; entry < entries; ++entry) {
    const plan::Snapshot snapshot = plan::MakePlannedSnapshot(plan, entry, {}, 0);
    fingers_.push_back(MakeFingerGlyphs(snapshot, frame_, body_.rays));
    captions_.push_back(PanelLabel(entry) + " " + EntryTitle(plan, entry));
  }
  axes_ = CameraAxes(
      options.view
          ? options.view->ToCamera()
          : ChooseViewpoints(body_, /*planar=*/false, fingers_, /*largest_force=*/0).common);
  Eigen::AlignedBox2d box;
  const auto extend = [&](const Vector3d& p) {
    box.extend(Vector2d((axes_.transpose() * p).head<2>()));
  };
  for (const auto& corners : body_.surface.triangles) {
    for (const Vector3d& p : corners) extend(p);
  }
  for (const std::vector<FingerGlyph>& fingers : fingers_) {
    for (const FingerGlyph& glyph : fingers) {
      extend(glyph.end);
      extend(glyph.contact);
      // A sphere around the rim contains the cone.
      const Vector3d rim = glyph.contact - kConeLength * std::cos(friction_angle_) * glyph.outward;
      const double radius = kConeLength * std::sin(friction_angle_);
      for (const int axis : {0, 1}) {
        extend(rim + radius * axes_.col(axis));
        extend(rim - radius * axes_.col(axis));
      }
    }
  }
  low_ = box.min();
  high_ = box.max();
}

double SolidPanels::HeightFor(double width) const {
  const Vector2d size = high_ - low_;
  const double height = (width - 2 * kMargin) * size.y() / size.x() + 2 * kMargin + kScaleBarSpace;
  return std::min(height, kTallestSolidPanel * width);
}

void SolidPanels::Draw(cairo_t* cr, int index, double width, bool scale_bar) const {
  const Vector2d panel(width, HeightFor(width));
  const Vector2d size = high_ - low_;
  const double scale = std::min((panel.x() - 2 * kMargin) / size.x(),
                                (panel.y() - 2 * kMargin - kScaleBarSpace) / size.y());
  const Vector2d middle = (low_ + high_) / 2;
  const PanelCamera camera = {
      axes_,
      scale,
      {middle.x() - panel.x() / 2 / scale, middle.y() + (panel.y() - kScaleBarSpace) / 2 / scale}};
  SolidPainter painter(cr, body_, camera);
  const std::vector<FingerGlyph>& fingers = fingers_[index];
  painter.DrawBody();
  for (const FingerGlyph& glyph : fingers) painter.DrawCone(glyph, friction_angle_);
  painter.DrawVisibleEdges();
  for (const FingerGlyph& glyph : fingers) painter.DrawStem(glyph);
  for (const FingerGlyph& glyph : fingers) painter.DrawMotion(glyph);
  const std::vector<FingerMarker> markers = painter.MarkersOf(fingers);
  for (const FingerMarker& marker : markers) DrawFingerMarker(cr, marker);
  painter.DrawNumbers(fingers, markers, panel);
  if (scale_bar) DrawScaleBar(cr, panel, scale / frame_.diameter_m);
}

}  // namespace regrasp::render
