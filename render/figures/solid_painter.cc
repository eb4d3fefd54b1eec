#include "render/figures/solid_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "render/figures/scan_outline.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/image.h"

namespace regrasp::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Lengths in points.
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

bool HasPath(const FingerGlyph& glyph) {
  return glyph.role == plan::FingerRole::kMoved && glyph.path.size() > 1;
}

/// Return the points in counter-clockwise order, so that overlapping outlines fill their union.
template <class Points>
Points TurnedLeft(Points points) {
  double area = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d& a = points[i];
    const Vector2d& b = points[(i + 1) % points.size()];
    area += a.x() * b.y() - a.y() * b.x();
  }
  if (area < 0) std::reverse(points.begin(), points.end());
  return points;
}

}  // namespace

PanelCamera PanelCamera::InFrame(const Eigen::Isometry3d& pose) const {
  const Vector2d moved = (axes.transpose() * pose.translation()).head<2>();
  return {pose.linear().transpose() * axes, scale, top_left - moved};
}

SolidPainter::SolidPainter(cairo_t* cr, const BodyShape& body, const PanelCamera& camera)
    : cr_(cr), body_(body), camera_(camera) {}

LineParts SolidPainter::Edges() const {
  std::vector<LineSegment> lines = body_.edges;
  if (!IsScan()) {
    for (const LineSegment& line :
         FindOutline(body_, [this](const Vector3d&) { return camera_.back(); })) {
      lines.push_back(line);
    }
  }
  return SplitByVisibility(body_.rays, lines, camera_.back());
}

void SolidPainter::FillScan() {
  ScanOutline scan = TraceScan(body_.surface, camera_);
  outlines_ = std::move(scan.lines);
  cairo_new_path(cr_);
  cairo_set_fill_rule(cr_, CAIRO_FILL_RULE_EVEN_ODD);
  for (const Polyline& area : scan.areas) AddOutline(cr_, area);
  Fill(cr_, kMaterial);
  edges_ = Edges();
  edges_.hidden.clear();  // hidden edges of a scan would cover it
}

void SolidPainter::StrokeScan(double width) const {
  cairo_new_path(cr_);
  for (const Polyline& line : outlines_) {
    cairo_new_sub_path(cr_);
    for (const Vector2d& p : line) cairo_line_to(cr_, p.x(), p.y());
  }
  cairo_set_line_join(cr_, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_width(cr_, width);
  cairo_stroke(cr_);
}

void SolidPainter::DrawBody() {
  if (IsScan()) {
    FillScan();
    return;
  }
  // Triangles that face the eye have the same orientation, so that they fill one area.
  cairo_new_path(cr_);
  cairo_set_fill_rule(cr_, CAIRO_FILL_RULE_WINDING);
  for (const auto& [a, b, c] : body_.surface.triangles) {
    if ((b - a).cross(c - a).dot(camera_.back()) <= 0) continue;
    AddOutline(cr_, std::array<Vector2d, 3>{camera_(a), camera_(b), camera_(c)});
  }
  FillAndStroke(cr_, kMaterial, kMaterial, kSeam);
  FillTints();
  edges_ = Edges();
  SetColor(cr_, kHiddenInk);
  cairo_set_dash(cr_, &kHiddenDash, 1, 0);
  for (const auto& [a, b] : edges_.hidden) StrokeLine(cr_, camera_(a), camera_(b), kHiddenEdge);
  cairo_set_dash(cr_, nullptr, 0, 0);
}

void SolidPainter::FillTints() {
  if (body_.surface.colors.empty()) return;
  cairo_set_fill_rule(cr_, CAIRO_FILL_RULE_EVEN_ODD);
  for (const TintedArea& tinted : TraceTints(body_.surface, camera_)) {
    cairo_new_path(cr_);
    for (const Polyline& area : tinted.areas) AddOutline(cr_, area);
    FillAndStroke(cr_, tinted.color, tinted.color, kSeam);
  }
}

void SolidPainter::DrawVisibleEdges() {
  cairo_set_line_cap(cr_, CAIRO_LINE_CAP_ROUND);
  SetColor(cr_, kInk);
  for (const auto& [a, b] : edges_.visible) StrokeLine(cr_, camera_(a), camera_(b), kEdge);
  StrokeScan(kEdge);
  cairo_set_line_cap(cr_, CAIRO_LINE_CAP_BUTT);
}

void SolidPainter::DrawCone(const FingerGlyph& glyph, double friction_angle) {
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

void SolidPainter::DrawStem(const FingerGlyph& glyph) {
  if (glyph.role == plan::FingerRole::kReleased) return;
  DrawLine({glyph.contact, glyph.stem_end}, FingerColor(glyph.finger), kStem);
}

void SolidPainter::DrawMotion(const FingerGlyph& glyph) {
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

std::vector<FingerMarker> SolidPainter::MarkersOf(const std::vector<FingerGlyph>& fingers) const {
  std::vector<FingerMarker> markers;
  for (const FingerGlyph& glyph : fingers) {
    if (!HasPath(glyph)) continue;
    markers.push_back({glyph.finger, camera_(glyph.path.front()), MarkerStyle::kHollow});
  }
  for (const FingerGlyph& glyph : fingers) {
    const MarkerStyle held = IsBehind(glyph) ? MarkerStyle::kPale : MarkerStyle::kFilled;
    const bool released = glyph.role == plan::FingerRole::kReleased;
    markers.push_back({glyph.finger, camera_(glyph.contact), released ? MarkerStyle::kHollow : held,
                       glyph.role == plan::FingerRole::kPlaced});
  }
  EnlargeCovered(markers);
  return markers;
}

void SolidPainter::DrawNumbers(const std::vector<FingerGlyph>& fingers,
                               const std::vector<FingerMarker>& markers, const Vector2d& size,
                               std::span<const std::string> names,
                               std::span<const Obstacle> covered) {
  std::vector<std::string> labels;
  std::vector<LabelAnchor> anchors;
  std::vector<Obstacle> obstacles(covered.begin(), covered.end());
  for (const auto& [a, b] : edges_.visible) {
    obstacles.push_back({camera_(a), camera_(b), 0, kEdgeWeight});
  }
  for (const Polyline& line : outlines_) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      obstacles.push_back({line[i - 1], line[i], 0, kEdgeWeight});
    }
  }
  for (const FingerGlyph& glyph : fingers) {
    const Vector2d contact = camera_(glyph.contact);
    const Vector2d end = camera_(glyph.end);
    labels.push_back(FingerLabel(glyph.finger, names));
    anchors.push_back({contact, end - contact, contact});
    obstacles.push_back({contact, end, kStem, kStemWeight});
  }
  for (const FingerMarker& marker : markers) {
    obstacles.push_back({marker.centre, marker.centre, marker.reach(), kSolidMarkerWeight});
  }
  render::DrawNumbers(cr_, labels, anchors, obstacles, size);
}

void SolidPainter::DrawGhost(Color color) {
  constexpr double kGhostEdge = 0.5, kGhostDash = 2.4;
  SetColor(cr_, color);
  cairo_set_dash(cr_, &kGhostDash, 1, 0);
  if (IsScan()) {
    outlines_ = TraceScan(body_.surface, camera_).lines;
    StrokeScan(kGhostEdge);
  } else {
    for (const auto& [a, b] : Edges().visible) StrokeLine(cr_, camera_(a), camera_(b), kGhostEdge);
  }
  cairo_set_dash(cr_, nullptr, 0, 0);
}

bool SolidPainter::IsBehind(const FingerGlyph& glyph) const {
  return IsHidden(body_.rays, glyph.contact + glyph.fingertip_radius * glyph.outward,
                  camera_.back());
}

/// Draw a line, thin and dashed if it is hidden.
void SolidPainter::DrawLine(const LineSegment& line, Color color, double width) {
  const LineParts parts = SplitByVisibility(body_.rays, {&line, 1}, camera_.back());
  SetColor(cr_, Paler(color, kBehindShare));
  for (const auto& [a, b] : parts.hidden) StrokeLine(cr_, camera_(a), camera_(b), width / 2);
  SetColor(cr_, color);
  for (const auto& [a, b] : parts.visible) StrokeLine(cr_, camera_(a), camera_(b), width);
}

}  // namespace regrasp::render
