#include "render/figures/solid_figure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "planner/plan/snapshot.h"
#include "render/figures/finger_marker.h"
#include "render/figures/hidden_lines.h"
#include "render/figures/panel_text.h"
#include "render/figures/plan_figure.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/caption.h"
#include "render/picture/color_table.h"

namespace regrasp::render {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// Points.
constexpr double kMargin = 10;               ///< for markers, arrow heads and numbers
constexpr double kTallestSolidPanel = 1.25;  ///< over its width
constexpr double kEdge = 0.8;
constexpr double kHiddenEdge = 0.35;
constexpr double kHiddenDash = 1.6;
constexpr double kStem = 2.0;
constexpr double kSolidConeBorder = 0.4;
constexpr double kSolidArrowWidth = 1.0;
constexpr double kSolidPathWidth = 0.9;

constexpr double kSolidConeFill = 0.26;  ///< opacity
constexpr Color kHiddenInk = {120, 128, 142};
constexpr int kConeSides = 48;

// What it costs a number to cover things: the weights of label_layout.h.
constexpr double kSolidMarkerWeight = 2;
constexpr double kStemWeight = 1.5;
constexpr double kEdgeWeight = 0.25;

/// Seams between triangles of one colour, points.
constexpr double kSeam = 0.4;

/// From the picture's frame to a panel, without perspective.
struct PanelCamera {
  Eigen::Matrix3d axes;
  double scale;       ///< points per diameter
  Vector2d top_left;  ///< what the panel's corner shows, along right and up

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
    // The triangles that face the eye turn the same way: together they are one area.
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

  /// The outline of a cone on the panel: its apex and what is seen of its rim.
  void DrawCone(const FingerGlyph& glyph, double half_angle) {
    if (glyph.role == plan::FingerRole::kReleased) return;
    const Vector3d axis = -glyph.outward;
    const Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
    const Vector2d apex = camera_(glyph.contact);
    std::vector<Vector2d> rim;
    for (int i = 0; i < kConeSides; ++i) {
      const double turn = 2 * M_PI * i / kConeSides;
      rim.push_back(camera_(
          glyph.contact +
          kConeLength * (std::cos(half_angle) * axis +
                         std::sin(half_angle) * (std::cos(turn) * u + std::sin(turn) * v))));
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

  /// The starts of moved fingers, then the contacts.
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
    return IsHidden(body_.rays, glyph.contact + glyph.ball_radius * glyph.outward, camera_.back());
  }

  /// Counter-clockwise, so that outlines that overlap fill what any of them covers.
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

  /// Thin and dashed where it is hidden.
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
      half_angle_(plan.half_angle) {
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
      // The cone fits into a ball about its rim.
      const Vector3d rim = glyph.contact - kConeLength * std::cos(half_angle_) * glyph.outward;
      const double radius = kConeLength * std::sin(half_angle_);
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
  for (const FingerGlyph& glyph : fingers) painter.DrawCone(glyph, half_angle_);
  painter.DrawVisibleEdges();
  for (const FingerGlyph& glyph : fingers) painter.DrawStem(glyph);
  for (const FingerGlyph& glyph : fingers) painter.DrawMotion(glyph);
  const std::vector<FingerMarker> markers = painter.MarkersOf(fingers);
  for (const FingerMarker& marker : markers) DrawFingerMarker(cr, marker);
  painter.DrawNumbers(fingers, markers, panel);
  DrawScaleBar(cr, panel, scale / frame_.diameter_m);
}

}  // namespace regrasp::render
