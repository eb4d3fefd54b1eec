#include "render/figures/planar_panel.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "render/figures/figure_page.h"
#include "render/figures/panel_sheet.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/caption.h"
#include "render/picture/image.h"

namespace regrasp::render {

namespace {

using Box = Eigen::AlignedBox2d;

Box BoxOf(const object::Polygon& polygon) {
  Box box;
  for (const Eigen::Vector2d& p : polygon.rings().front()) box.extend(p);
  return box;
}

}  // namespace

PanelView FitView(const object::Polygon& polygon, std::span<const StepDiagram> diagrams,
                  double width) {
  assert(width > 2 * kPanelMargin);
  const Box object = BoxOf(polygon);
  Box shown = object;
  for (const StepDiagram& diagram : diagrams) {
    const auto& focus = diagram.grasp.focus;
    const bool near = focus && object.exteriorDistance(*focus) <= kFocusOnPage * polygon.diameter();
    if (near) shown.extend(*focus);
  }
  const Eigen::Vector2d size = shown.sizes();
  const double space = width - 2 * kPanelMargin;
  const double tallest = kTallestPanel * width - 2 * kPanelMargin;
  PanelView view;
  view.width = width;
  view.scale = std::min(space / size.x(), tallest / size.y());
  view.height = view.scale * size.y() + 2 * kPanelMargin;
  view.centre = shown.center();
  return view;
}

using Eigen::Vector2d;

namespace {

/// Length of a sum of normals below which they are opposite up to rounding, so that any direction
/// is valid.
constexpr double kOpposite = 1e-9;

/// Return the waypoints on the panel. Consecutive waypoints at one position are merged.
std::vector<BorderPoint> Merged(std::span<const BorderPoint> path, const PanelView& view) {
  std::vector<BorderPoint> merged;
  const Vector2d* last = nullptr;
  for (const BorderPoint& point : path) {
    const Vector2d outward = PanelView::ToPanelDirection(point.outward);
    if (last != nullptr && *last == point.p) {
      merged.back().outward += outward;
    } else {
      merged.push_back({view.ToPanel(point.p), outward});
    }
    last = &point.p;
  }
  for (BorderPoint& point : merged) {
    if (point.outward.norm() > kOpposite) point.outward.normalize();
  }
  return merged;
}

}  // namespace

PanelPath PathBeside(std::span<const BorderPoint> path, const PanelView& view, double distance) {
  const std::vector<BorderPoint> merged = Merged(path, view);
  std::vector<std::size_t> kept;
  const auto beside = [&](std::size_t i) -> Vector2d {
    return merged[i].p + distance * merged[i].outward;
  };
  for (std::size_t i = 0; i < merged.size(); ++i) {
    const auto goes_backwards = [&](std::size_t from) {
      return (beside(i) - beside(from)).dot(merged[i].p - merged[from].p) <= 0;
    };
    while (kept.size() > 1 && goes_backwards(kept.back())) kept.pop_back();
    kept.push_back(i);
  }
  PanelPath result;
  for (const std::size_t i : kept) result.points.push_back(beside(i));
  for (std::size_t k = 1; k + 1 < kept.size(); ++k) {
    const Vector2d& at = result.points[k];
    const Vector2d& before = result.ticks.empty() ? result.points.front() : result.ticks.back().at;
    const bool apart =
        (at - before).norm() >= kPathTickGap && (at - result.points.back()).norm() >= kPathTickGap;
    if (apart) result.ticks.push_back({at, merged[kept[k]].outward});
  }
  return result;
}

namespace {

// Lengths in points unless stated otherwise.
constexpr double kPanelConeLength = 0.2;  ///< length of cones per diameter of the polygon
constexpr double kConeBorder = 0.4;
constexpr double kConeFill = 0.26;  ///< opacity of cones
constexpr double kLongConeFill = 0.12;
constexpr double kConeBorderOpacity = 0.8;
constexpr double kBeyondFocus = 1.12;  ///< length of cones per distance from contact to focus point
constexpr double kLongestOuter = kPanelMargin - 2;  ///< cones end inside the panel
constexpr double kConeInset = 1;       ///< distance of cones from the border of the panel
constexpr double kShortestInner = 12;  ///< minimum length, even without space
constexpr Hatch kConeHatch = {.slope = 1, .spacing = 3.2, .width = 0.35};
constexpr double kCellBorder = 0.5;
constexpr double kForceLine = 0.55;
constexpr double kForceLineInset = 4;  ///< distance of lines from the border of the panel
constexpr double kConeDash = 3;
constexpr double kFocusRadius = 1.7;

constexpr Color kConeHatchInk = {168, 174, 184};
constexpr Color kCellInk = {96, 104, 118};

/// The part of one side of a cone between two distances from its apex.
struct Sector {
  Vector2d apex;
  double middle;          ///< angle of the axis, radians
  double friction_angle;  ///< angle between axis and border, radians
  double from = 0;
  double to = 0;
};

void FillSector(cairo_t* cr, const Sector& sector, Color color, double opacity) {
  const auto& [apex, middle, friction_angle, from, to] = sector;
  cairo_new_path(cr);
  cairo_arc(cr, apex.x(), apex.y(), to, middle - friction_angle, middle + friction_angle);
  if (from > 0) {
    cairo_arc_negative(cr, apex.x(), apex.y(), from, middle + friction_angle,
                       middle - friction_angle);
  } else {
    cairo_line_to(cr, apex.x(), apex.y());
  }
  cairo_close_path(cr);
  Fill(cr, color, opacity);
}

/// Draw one side of a cone with a round end, paler beyond `default_length`.
void DrawSide(cairo_t* cr, const Vector2d& apex, const Vector2d& axis, double friction_angle,
              double default_length, double length, Color color) {
  const double middle = std::atan2(axis.y(), axis.x());
  FillSector(cr, {apex, middle, friction_angle, 0, std::min(default_length, length)}, color,
             kConeFill);
  if (length > default_length) {
    FillSector(cr, {apex, middle, friction_angle, default_length, length}, color, kLongConeFill);
  }
  SetColor(cr, color, kConeBorderOpacity);
  for (const double side : {-friction_angle, friction_angle}) {
    const Vector2d direction(std::cos(middle + side), std::sin(middle + side));
    StrokeLine(cr, apex, apex + length * direction, kConeBorder);
  }
}

/// Return the maximum length of one side of a cone within the panel, including its borders.
double LengthOnPanel(const DoubleCone& cone, int side, const PanelView& view) {
  const Vector2d apex = view.ToPanel(cone.apex);
  const Vector2d axis = side * PanelView::ToPanelDirection(cone.axis);
  const Vector2d corner(view.width, view.height);
  double length = corner.norm();
  for (const double turn : {-cone.friction_angle, 0.0, cone.friction_angle}) {
    const Vector2d direction = Eigen::Rotation2Dd(turn) * axis;
    for (int k = 0; k < 2; ++k) {
      if (direction[k] == 0) continue;
      const double border = direction[k] > 0 ? corner[k] - kConeInset : kConeInset;
      length = std::min(length, (border - apex[k]) / direction[k]);
    }
  }
  return length;
}

double DefaultLength(const object::Polygon& polygon, const DoubleCone& cone, int side,
                     const PanelView& view) {
  const double default_length = kPanelConeLength * view.scale * polygon.diameter();
  if (side < 0) return std::min(default_length, kLongestOuter);
  return std::min(default_length, std::max(LengthOnPanel(cone, side, view), kShortestInner));
}

/// Return the part of the line through `p` along `d` slightly inside the panel.
std::array<Vector2d, 2> LineOnPanel(const Vector2d& p, const Vector2d& d, const PanelView& view) {
  const Vector2d corner(view.width, view.height);
  double from = -corner.norm();
  double to = corner.norm();
  for (int k = 0; k < 2; ++k) {
    if (d[k] == 0) continue;
    const double a = (kForceLineInset - p[k]) / d[k];
    const double b = (corner[k] - kForceLineInset - p[k]) / d[k];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return {p + from * d, p + to * d};
}

std::vector<Vector2d> OnPanel(const Outline& outline, const PanelView& view) {
  std::vector<Vector2d> points;
  for (const Vector2d& p : outline) points.push_back(view.ToPanel(p));
  return points;
}

}  // namespace

double ConeLength(const object::Polygon& polygon, const GraspDiagram& grasp, const DoubleCone& cone,
                  int side, const PanelView& view) {
  const double length = DefaultLength(polygon, cone, side, view);
  if (!grasp.focus || side * cone.axis.dot(*grasp.focus - cone.apex) <= 0) return length;
  return std::max(length, kBeyondFocus * view.scale * (*grasp.focus - cone.apex).norm());
}

void DrawCones(cairo_t* cr, const object::Polygon& polygon, const StepDiagram& diagram,
               const PanelView& view) {
  const GraspDiagram& grasp = diagram.grasp;
  for (std::size_t i = 0; i < grasp.cones.size(); ++i) {
    const DoubleCone& cone = grasp.cones[i];
    for (const int side : {1, -1}) {
      DrawSide(cr, view.ToPanel(cone.apex), side * PanelView::ToPanelDirection(cone.axis),
               cone.friction_angle, DefaultLength(polygon, cone, side, view),
               ConeLength(polygon, grasp, cone, side, view),
               FingerColor(diagram.fingers[i].finger));
    }
  }
}

void DrawFocusCell(cairo_t* cr, const GraspDiagram& grasp, const PanelView& view) {
  if (grasp.focus_cell.empty()) return;
  cairo_save(cr);
  cairo_new_path(cr);
  for (const Outline& part : grasp.focus_cell) AddOutline(cr, OnPanel(part, view));
  cairo_clip(cr);
  DrawHatch(cr, {0, 0}, {view.width, view.height}, kConeHatch, kConeHatchInk);
  cairo_restore(cr);
  cairo_new_path(cr);
  for (const Outline& part : grasp.focus_cell) AddOutline(cr, OnPanel(part, view));
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  Stroke(cr, kCellInk, kCellBorder);
}

void DrawForceLines(cairo_t* cr, const GraspDiagram& grasp, const PanelView& view) {
  SetColor(cr, kInk);
  for (const DoubleCone& cone : grasp.cones) {
    const Vector2d p = view.ToPanel(cone.apex);
    if (grasp.focus) StrokeLine(cr, p, view.ToPanel(*grasp.focus), kForceLine);
    if (grasp.force_direction) {
      const auto [a, b] = LineOnPanel(p, PanelView::ToPanelDirection(*grasp.force_direction), view);
      StrokeLine(cr, a, b, kForceLine);
    }
  }
  if (grasp.kind == DiagramKind::kTwoFinger) {
    cairo_set_dash(cr, &kConeDash, 1, 0);
    StrokeLine(cr, view.ToPanel(grasp.cones[0].apex), view.ToPanel(grasp.cones[1].apex),
               kForceLine);
    cairo_set_dash(cr, nullptr, 0, 0);
  }
}

void DrawFocusPoint(cairo_t* cr, const GraspDiagram& grasp, const PanelView& view) {
  if (grasp.focus) DrawDot(cr, view.ToPanel(*grasp.focus), kFocusRadius);
}

namespace {

// Lengths in points.
constexpr double kArrowWidth = 1.0;
/// Distance from the contact to the arrow of a placed or released finger.
constexpr double kArrowNear = 6.2;
constexpr double kArrowFar = 16;
constexpr double kPathOffset = 4.4;  ///< distance from the border to the arrow of a sliding finger
constexpr double kTick = 1.6;        ///< half the length of a tick

/// Maximum length of an arrow in a hole or a notch, per clearance.
constexpr double kShareOfClearance = 0.8;

/// Distance of two fingers below which their arrows are moved aside, and the offset.
constexpr double kNearby = 7;
constexpr double kAside = 3;

/// Length of a path below which it has no arrow, because the marker covers it, points.
constexpr double kShortestPath = 1;

/// Costs of covering an element with a number (see PlaceLabels).
constexpr double kMarkerWeight = 2;
constexpr double kArrowWeight = 1.5;
constexpr double kFocusWeight = 1.5;
constexpr double kLineWeight = 0.4;
constexpr double kBorderWeight = 0.25;
constexpr double kConeWeight = 0.12;

/// Return the markers of the starts of sliding fingers, then of the contacts.
std::vector<FingerMarker> MarkersOf(const StepDiagram& diagram, const PanelView& view) {
  std::vector<FingerMarker> markers;
  for (const DiagramFinger& finger : diagram.fingers) {
    if (finger.role != plan::FingerRole::kMoved) continue;
    markers.push_back({finger.finger, view.ToPanel(finger.path.front().p), MarkerStyle::kHollow});
  }
  for (const DiagramFinger& finger : diagram.fingers) {
    const bool released = finger.role == plan::FingerRole::kReleased;
    markers.push_back({finger.finger, view.ToPanel(finger.contact.p),
                       released ? MarkerStyle::kHollow : MarkerStyle::kFilled,
                       finger.role == plan::FingerRole::kPlaced});
  }
  EnlargeCovered(markers);
  return markers;
}

struct FingerShape {
  const DiagramFinger* finger;
  Vector2d contact;
  Vector2d outward;
  std::vector<Vector2d> arrow;  ///< empty if there is no arrow
};

/// Return the arrow of a finger; empty for none.
/// @param marker_radius  radius of the marker at the contact, points.
std::vector<Vector2d> ArrowOf(const object::Polygon& polygon, const DiagramFinger& finger,
                              double marker_radius, const PanelView& view) {
  const Vector2d contact = view.ToPanel(finger.contact.p);
  const Vector2d outward = PanelView::ToPanelDirection(finger.contact.outward);
  const double clearance =
      kShareOfClearance * view.scale * OutwardClearance(polygon, finger.contact);
  const double enlarged = marker_radius - kMarkerRadius;
  const double near = kArrowNear + enlarged;
  const double far = std::min(kArrowFar + enlarged, std::max(clearance, near + kArrowHead));
  const Vector2d near_end = contact + near * outward;
  const Vector2d far_end = contact + far * outward;
  switch (finger.role) {
    case plan::FingerRole::kPlaced:
      return {far_end, near_end};
    case plan::FingerRole::kReleased:
      return {near_end, far_end};
    case plan::FingerRole::kMoved: {
      const std::vector<Vector2d> path = PathBeside(finger.path, view, kPathOffset).points;
      double length = 0;
      for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
      return length < kShortestPath ? std::vector<Vector2d>() : path;
    }
    case plan::FingerRole::kFree:
    case plan::FingerRole::kHolding:
      break;
  }
  return {};
}

/// Move an arrow aside if one finger replaces another, so that both arrows are visible.
void MoveArrowAside(FingerShape& shape, const std::vector<FingerShape>& shapes) {
  const plan::FingerRole role = shape.finger->role;
  if (role != plan::FingerRole::kPlaced && role != plan::FingerRole::kReleased) return;
  const Vector2d tangent(-shape.outward.y(), shape.outward.x());
  for (const FingerShape& other : shapes) {
    const Vector2d away = shape.contact - other.contact;
    if (&other == &shape || other.arrow.empty() || away.norm() > kNearby) continue;
    const double along = away.dot(tangent);
    const bool forward = along != 0 ? along > 0 : role == plan::FingerRole::kPlaced;
    for (Vector2d& p : shape.arrow) p += (forward ? kAside : -kAside) * tangent;
    return;
  }
}

/// Return the shapes of all fingers.
/// @param contacts  markers of the fingers of the diagram.
std::vector<FingerShape> ShapesOf(const object::Polygon& polygon, const StepDiagram& diagram,
                                  std::span<const FingerMarker> contacts, const PanelView& view) {
  std::vector<FingerShape> shapes;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const DiagramFinger& finger = diagram.fingers[i];
    shapes.push_back({&finger, contacts[i].centre,
                      PanelView::ToPanelDirection(finger.contact.outward),
                      ArrowOf(polygon, finger, contacts[i].radius, view)});
  }
  for (FingerShape& shape : shapes) MoveArrowAside(shape, shapes);
  return shapes;
}

void DrawMotion(cairo_t* cr, const FingerShape& shape, const PanelView& view) {
  const DiagramFinger& finger = *shape.finger;
  const Color color = FingerColor(finger.finger);
  SetColor(cr, color);
  StrokeArrow(cr, shape.arrow, kArrowWidth);
  if (finger.role != plan::FingerRole::kMoved) return;
  for (const auto& [at, across] : PathBeside(finger.path, view, kPathOffset).ticks) {
    SetColor(cr, color);
    StrokeLine(cr, at - kTick * across, at + kTick * across, kArrowWidth);
  }
}

std::vector<Obstacle> ObstaclesOf(const object::Polygon& polygon, const StepDiagram& diagram,
                                  const std::vector<FingerShape>& shapes,
                                  const std::vector<FingerMarker>& markers, const PanelView& view) {
  std::vector<Obstacle> obstacles;
  for (FaceIndex face{0}; face < polygon.face_count(); ++face) {
    const auto [a, b] = polygon.edge(face);
    obstacles.push_back({view.ToPanel(a.head<2>()), view.ToPanel(b.head<2>()), 0, kBorderWeight});
  }
  for (const FingerMarker& marker : markers) {
    obstacles.push_back({marker.centre, marker.centre, marker.reach(), kMarkerWeight});
  }
  for (const FingerShape& shape : shapes) {
    for (std::size_t i = 1; i < shape.arrow.size(); ++i) {
      obstacles.push_back({shape.arrow[i - 1], shape.arrow[i], 1, kArrowWeight});
    }
  }
  for (const DoubleCone& cone : diagram.grasp.cones) {
    const Vector2d apex = view.ToPanel(cone.apex);
    for (const int side : {1, -1}) {
      const double length = ConeLength(polygon, diagram.grasp, cone, side, view);
      const Vector2d axis = side * length * PanelView::ToPanelDirection(cone.axis);
      obstacles.push_back(
          {apex, apex + axis, length * std::sin(cone.friction_angle) / 2, kConeWeight});
    }
    if (diagram.grasp.force_direction) {
      const Vector2d offset =
          (view.width + view.height) * PanelView::ToPanelDirection(*diagram.grasp.force_direction);
      obstacles.push_back({apex - offset, apex + offset, 0, kLineWeight});
    }
    if (diagram.grasp.focus) {
      const Vector2d focus = view.ToPanel(*diagram.grasp.focus);
      obstacles.push_back({apex, focus, 0, kLineWeight});
      obstacles.push_back({focus, focus, 2, kFocusWeight});
    }
  }
  return obstacles;
}

}  // namespace

double OutwardClearance(const object::Polygon& polygon, const BorderPoint& from) {
  double clearance = std::numeric_limits<double>::infinity();
  for (FaceIndex face{0}; face < polygon.face_count(); ++face) {
    const auto [begin, end] = polygon.edge(face);
    const Vector2d a = begin.head<2>() - from.p;
    const Vector2d along = (end - begin).head<2>();
    const double slope = Cross(from.outward, along);
    if (slope == 0) continue;
    const double distance = Cross(a, along) / slope;
    const double place = Cross(a, from.outward) / slope;
    const bool hit =
        place >= 0 && place <= 1 && distance > object::kPointTolerance * polygon.diameter();
    if (hit) clearance = std::min(clearance, distance);
  }
  return clearance;
}

void DrawFingers(cairo_t* cr, const object::Polygon& polygon, const StepDiagram& diagram,
                 const PanelView& view) {
  const std::vector<FingerMarker> markers = MarkersOf(diagram, view);
  const std::vector<FingerShape> shapes =
      ShapesOf(polygon, diagram, std::span(markers).last(diagram.fingers.size()), view);
  std::vector<std::string> names;
  std::vector<LabelAnchor> anchors;
  for (const FingerShape& shape : shapes) {
    DrawMotion(cr, shape, view);
    names.push_back(std::to_string(shape.finger->finger));
    anchors.push_back({shape.contact, shape.outward});
  }
  for (const FingerMarker& marker : markers) DrawFingerMarker(cr, marker);
  const std::vector<Obstacle> obstacles = ObstaclesOf(polygon, diagram, shapes, markers, view);
  DrawNumbers(cr, names, anchors, obstacles, {view.width, view.height});
}

}  // namespace regrasp::render
