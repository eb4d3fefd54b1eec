#include "render/figures/solid_figure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "planner/plan/projection.h"
#include "render/figures/figure_page.h"
#include "render/figures/panel_sheet.h"
#include "render/figures/plan_figure.h"
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
constexpr double kEdge = 0.8;
constexpr double kHiddenEdge = 0.35;
constexpr double kHiddenDash = 1.6;
constexpr double kStem = 2.0;
constexpr double kSolidConeBorder = 0.4;
constexpr double kSolidArrowWidth = 1.0;
constexpr double kSolidPathWidth = 0.9;

constexpr double kSolidConeFill = 0.26;  ///< opacity of cones
constexpr Color kHiddenInk = {120, 128, 142};
constexpr int kConeSides = 48;

// Costs of covering an element with a number (see PlaceLabels).
constexpr double kSolidMarkerWeight = 2;
constexpr double kStemWeight = 1.5;
constexpr double kEdgeWeight = 0.25;

/// Line width that closes seams between triangles of one colour, points.
constexpr double kSeam = 0.4;

/// A parallel projection from the normalized frame to a panel.
struct PanelCamera {
  Eigen::Matrix3d axes;
  double scale;       ///< scale, points per diameter
  Vector2d top_left;  ///< coordinates of the panel's corner along right and up

  [[nodiscard]] Vector2d operator()(const Vector3d& p) const {
    const Vector2d flat = (axes.transpose() * p).head<2>();
    return {scale * (flat.x() - top_left.x()), scale * (top_left.y() - flat.y())};
  }
  [[nodiscard]] Vector3d back() const { return axes.col(2); }
};

class SolidPainter {
 public:
  SolidPainter(cairo_t* cr, const BodyShape& body, const PanelCamera& camera)
      : cr_(cr), body_(body), camera_(camera) {}

  void DrawBody() {
    // Triangles that face the eye have the same orientation, so that they fill one area.
    cairo_new_path(cr_);
    cairo_set_fill_rule(cr_, CAIRO_FILL_RULE_WINDING);
    for (const auto& [a, b, c] : body_.surface.triangles) {
      if ((b - a).cross(c - a).dot(camera_.back()) <= 0) continue;
      AddOutline(cr_, std::array<Vector2d, 3>{camera_(a), camera_(b), camera_(c)});
    }
    FillAndStroke(cr_, kMaterial, kMaterial, kSeam);
    std::vector<LineSegment> lines = body_.edges;
    for (const LineSegment& line :
         FindOutline(body_, [this](const Vector3d&) { return camera_.back(); })) {
      lines.push_back(line);
    }
    edges_ = SplitByVisibility(body_.rays, lines, camera_.back());
    SetColor(cr_, kHiddenInk);
    cairo_set_dash(cr_, &kHiddenDash, 1, 0);
    for (const auto& [a, b] : edges_.hidden) StrokeLine(cr_, camera_(a), camera_(b), kHiddenEdge);
    cairo_set_dash(cr_, nullptr, 0, 0);
  }

  void DrawVisibleEdges() {
    cairo_set_line_cap(cr_, CAIRO_LINE_CAP_ROUND);
    SetColor(cr_, kInk);
    for (const auto& [a, b] : edges_.visible) StrokeLine(cr_, camera_(a), camera_(b), kEdge);
    cairo_set_line_cap(cr_, CAIRO_LINE_CAP_BUTT);
  }

  /// Draw the outline of a cone: its apex and the visible part of its rim.
  void DrawCone(const FingerGlyph& glyph, double friction_angle) {
    if (glyph.role == plan::FingerRole::kReleased) return;
    const Vector3d axis = -glyph.outward;
    const Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
    const Vector2d apex = camera_(glyph.contact);
    std::vector<Vector2d> rim;
    for (int i = 0; i < kConeSides; ++i) {
      const double turn = 2 * M_PI * i / kConeSides;
      rim.push_back(camera_(
          glyph.contact +
          kConeLength * (std::cos(friction_angle) * axis +
                         std::sin(friction_angle) * (std::cos(turn) * u + std::sin(turn) * v))));
    }
    const Color color = FingerColor(glyph.finger);
    cairo_new_path(cr_);
    for (std::size_t i = 0; i < rim.size(); ++i) {
      const std::array<Vector2d, 3> slice = {apex, rim[i], rim[(i + 1) % rim.size()]};
      AddOutline(cr_, TurnedLeft(slice));
    }
    AddOutline(cr_, TurnedLeft(rim));
    cairo_set_fill_rule(cr_, CAIRO_FILL_RULE_WINDING);
    Fill(cr_, color, kSolidConeFill);
    cairo_new_path(cr_);
    AddOutline(cr_, rim);
    Stroke(cr_, Paler(color, 0.7), kSolidConeBorder);
  }

  void DrawStem(const FingerGlyph& glyph) {
    if (glyph.role == plan::FingerRole::kReleased) return;
    DrawLine({glyph.contact, glyph.stem_end}, FingerColor(glyph.finger), kStem);
  }

  void DrawMotion(const FingerGlyph& glyph) {
    const Color own = FingerColor(glyph.finger);
    SetColor(cr_, IsBehind(glyph) ? Paler(own, kBehindShare) : own);
    std::vector<Vector2d> path;
    if (HasPath(glyph)) {
      for (const Vector3d& p : glyph.path) path.push_back(camera_(p));
      StrokeArrow(cr_, path, kSolidPathWidth);
    } else if (glyph.role == plan::FingerRole::kPlaced) {
      path = {camera_(glyph.end), camera_(glyph.stem_end)};
      StrokeArrow(cr_, path, kSolidArrowWidth);
    } else if (glyph.role == plan::FingerRole::kReleased) {
      path = {camera_(glyph.stem_end), camera_(glyph.end)};
      StrokeArrow(cr_, path, kSolidArrowWidth);
    }
  }

  /// Return the markers of the starts of sliding fingers, then of the contacts.
  [[nodiscard]] std::vector<FingerMarker> MarkersOf(const std::vector<FingerGlyph>& fingers) const {
    std::vector<FingerMarker> markers;
    for (const FingerGlyph& glyph : fingers) {
      if (!HasPath(glyph)) continue;
      markers.push_back({glyph.finger, camera_(glyph.path.front()), MarkerStyle::kHollow});
    }
    for (const FingerGlyph& glyph : fingers) {
      const MarkerStyle held = IsBehind(glyph) ? MarkerStyle::kPale : MarkerStyle::kFilled;
      const bool released = glyph.role == plan::FingerRole::kReleased;
      markers.push_back({glyph.finger, camera_(glyph.contact),
                         released ? MarkerStyle::kHollow : held,
                         glyph.role == plan::FingerRole::kPlaced});
    }
    EnlargeCovered(markers);
    return markers;
  }

  void DrawNumbers(const std::vector<FingerGlyph>& fingers,
                   const std::vector<FingerMarker>& markers, const Vector2d& size) {
    std::vector<std::string> names;
    std::vector<LabelAnchor> anchors;
    std::vector<Obstacle> obstacles;
    for (const auto& [a, b] : edges_.visible) {
      obstacles.push_back({camera_(a), camera_(b), 0, kEdgeWeight});
    }
    for (const FingerGlyph& glyph : fingers) {
      const Vector2d contact = camera_(glyph.contact);
      const Vector2d end = camera_(glyph.end);
      names.push_back(std::to_string(glyph.finger));
      anchors.push_back({contact, end - contact, contact});
      obstacles.push_back({contact, end, kStem, kStemWeight});
    }
    for (const FingerMarker& marker : markers) {
      obstacles.push_back({marker.centre, marker.centre, marker.reach(), kSolidMarkerWeight});
    }
    render::DrawNumbers(cr_, names, anchors, obstacles, size);
  }

 private:
  [[nodiscard]] static bool HasPath(const FingerGlyph& glyph) {
    return glyph.role == plan::FingerRole::kMoved && glyph.path.size() > 1;
  }
  [[nodiscard]] bool IsBehind(const FingerGlyph& glyph) const {
    return IsHidden(body_.rays, glyph.contact + glyph.fingertip_radius * glyph.outward,
                    camera_.back());
  }

  /// Return the points in counter-clockwise order, so that overlapping outlines fill their union.
  template <class Points>
  static Points TurnedLeft(Points points) {
    double area = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector2d& a = points[i];
      const Vector2d& b = points[(i + 1) % points.size()];
      area += a.x() * b.y() - a.y() * b.x();
    }
    if (area < 0) std::reverse(points.begin(), points.end());
    return points;
  }

  /// Draw a line, thin and dashed if it is hidden.
  void DrawLine(const LineSegment& line, Color color, double width) {
    const LineParts parts = SplitByVisibility(body_.rays, {&line, 1}, camera_.back());
    SetColor(cr_, Paler(color, kBehindShare));
    for (const auto& [a, b] : parts.hidden) StrokeLine(cr_, camera_(a), camera_(b), width / 2);
    SetColor(cr_, color);
    for (const auto& [a, b] : parts.visible) StrokeLine(cr_, camera_(a), camera_(b), width);
  }

  cairo_t* cr_;
  const BodyShape& body_;
  const PanelCamera& camera_;
  LineParts edges_;
};

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

void SolidPanels::Draw(cairo_t* cr, int index, double width) const {
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
  DrawScaleBar(cr, panel, scale / frame_.diameter_m);
}

}  // namespace regrasp::render
