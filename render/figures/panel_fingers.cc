#include "render/figures/panel_fingers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "render/figures/finger_marker.h"
#include "render/figures/panel_grasp.h"
#include "render/figures/panel_path.h"
#include "render/figures/panel_sheet.h"
#include "render/figures/panel_text.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/color_table.h"
#include "render/picture/label_layout.h"

namespace regrasp::render {

using Eigen::Vector2d;

namespace {

// Points.
constexpr double kArrowWidth = 1.0;
constexpr double kArrowNear =
    6.2;  ///< from the contact to the arrow of a placed or released finger
constexpr double kArrowFar = 16;
constexpr double kPathOffset = 4.4;  ///< from the border to the arrow of a moved finger
constexpr double kTick = 1.6;        ///< half of its length

/// An arrow into a hole or a notch takes this share of the clearance there.
constexpr double kShareOfClearance = 0.8;

/// Two fingers nearer than this have their arrows this far aside, so that they don't overlap.
constexpr double kNearby = 7;
constexpr double kAside = 3;

/// A moved finger whose path is shorter, points, has no arrow: its marker covers it.
constexpr double kShortestPath = 1;

/// What it costs a number to cover things: the weights of label_layout.h.
constexpr double kMarkerWeight = 2;
constexpr double kArrowWeight = 1.5;
constexpr double kFocusWeight = 1.5;
constexpr double kLineWeight = 0.4;
constexpr double kBorderWeight = 0.25;
constexpr double kConeWeight = 0.12;

/// The starts of moved fingers, then the contacts.
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
  std::vector<Vector2d> arrow;  ///< empty where there is none
};

/// @param marker_radius  of the contact's.
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

/// Where one finger takes the place of another, one arrow arrives beside the one that leaves.
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

/// @param contacts  the markers of the diagram's fingers.
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
      obstacles.push_back({apex, apex + axis, length * std::sin(cone.half_angle) / 2, kConeWeight});
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
