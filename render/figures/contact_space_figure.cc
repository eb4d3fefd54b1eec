#include "render/figures/contact_space_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "planner/base/number.h"
#include "render/figures/contact_space_map.h"
#include "render/figures/contact_space_switch.h"
#include "render/figures/figure_page.h"
#include "render/figures/panel_sheet.h"
#include "render/figures/plan_figure.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/caption.h"

namespace regrasp::render {

using Eigen::Vector2d;

namespace {

// Lengths in points.
constexpr double kOverviewTopSpace = 8;
constexpr double kOverviewRightSpace = 13;
constexpr double kRingGap = 22;
constexpr double kOverviewPathWidth = 1;
constexpr double kSwitchWidth = 0.7;
constexpr double kOverviewDotRadius = 1.6;
constexpr double kMarkRadius = 4.4;

/// Minimum length of a ring relative to the longest one.
constexpr double kLeastShare = 0.25;
/// Number of edges above which a figure is two columns wide.
constexpr int kManyEdges = 60;

constexpr Color kOverviewHatchInk = {120, 126, 136};
constexpr Color kOtherBorder = {150, 155, 164};

/// Costs of covering an object with a number (see PlaceLabels).
constexpr double kDotWeight = 2;
constexpr double kTravelWeight = 0.8;

/// Range of a ring along an axis of the page.
struct RingSpan {
  double from;
  double length;
};

class Overview {
 public:
  /// Lay out an overview. All arguments must outlive it.
  Overview(const contour::Boundary& boundary, const ContactSpaceMap& map, const AxisUnit& unit);

  [[nodiscard]] double width() const { return kLeftSpace + extent_ + kOverviewRightSpace; }
  [[nodiscard]] double height() const { return kOverviewTopSpace + extent_ + kBottomSpace; }
  void Draw(cairo_t* cr) const;

 private:
  [[nodiscard]] int IndexOf(contour::RingIndex ring) const {
    return static_cast<int>(std::ranges::find(map_.rings, ring) - map_.rings.begin());
  }
  [[nodiscard]] PlotWindow WindowOf(const std::array<contour::RingIndex, 2>& rings) const;
  [[nodiscard]] Vector2d ToPage(const SpacePoint& p) const {
    return WindowOf(p.rings).ToPage(p.places);
  }
  void DrawSets(cairo_t* cr, const std::array<contour::RingIndex, 2>& rings) const;
  void DrawAxes(cairo_t* cr) const;
  void DrawPlan(cairo_t* cr) const;
  [[nodiscard]] bool HasClearanceAt(const MapSet& set, const SpacePoint& place) const;
  void DrawMarks(cairo_t* cr) const;

  const contour::Boundary& boundary_;
  const ContactSpaceMap& map_;
  const AxisUnit& unit_;
  std::vector<RingSpan> spans_;
  double extent_ = 0;  ///< total length of rings and gaps, points
};

Overview::Overview(const contour::Boundary& boundary, const ContactSpaceMap& map,
                   const AxisUnit& unit)
    : boundary_(boundary), map_(map), unit_(unit) {
  std::vector<double> shares;
  int edges = 0;
  for (const contour::RingIndex ring : map.rings) {
    shares.push_back(boundary.perimeter(ring));
    edges += boundary.end_edge(ring) - boundary.first_edge(ring);
  }
  const double longest = std::ranges::max(shares);
  for (double& share : shares) share = std::max(share, kLeastShare * longest);
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  const bool wide = shares.size() > 1 || edges > kManyEdges;
  extent_ = (wide ? kTwoColumnWidth : kColumnWidth) - kLeftSpace - kOverviewRightSpace;
  const double drawn = extent_ - static_cast<double>(shares.size() - 1) * kRingGap;
  double from = 0;
  for (const double share : shares) {
    spans_.push_back({from, drawn * share / sum});
    from += spans_.back().length + kRingGap;
  }
}

PlotWindow Overview::WindowOf(const std::array<contour::RingIndex, 2>& rings) const {
  const RingSpan& across = spans_[IndexOf(rings[0])];
  const RingSpan& up = spans_[IndexOf(rings[1])];
  PlotWindow window;
  window.high = {boundary_.perimeter(rings[0]), boundary_.perimeter(rings[1])};
  window.scale = Vector2d(across.length, up.length).cwiseQuotient(window.high);
  window.corner = {kLeftSpace + across.from, kOverviewTopSpace + extent_ - up.from - up.length};
  return window;
}

void Overview::DrawSets(cairo_t* cr, const std::array<contour::RingIndex, 2>& rings) const {
  const PlotWindow window = WindowOf(rings);
  SaveAndClip(cr, window);
  std::vector<Outline> hatched;
  for (const MapSet& set : map_.sets) {
    std::vector<Outline> pieces;
    for (const SpaceShape& shape : set.pieces) {
      if (shape.rings == rings) pieces.push_back(shape.points);
    }
    FillPieces(cr, window, pieces, set.name ? PlanSetTint(*set.name) : OtherSetTint(set.set));
    if (set.stretching) hatched.insert(hatched.end(), pieces.begin(), pieces.end());
  }
  HatchPieces(cr, window, hatched, kOverviewHatchInk);
  for (const bool named : {false, true}) {
    std::vector<Segment> border;
    for (const MapSet& set : map_.sets) {
      if (set.name.has_value() != named) continue;
      for (const SpaceShape& shape : set.border) {
        if (shape.rings == rings) border.push_back({shape.points[0], shape.points[1]});
      }
    }
    StrokeSegments(cr, window, border, named ? kInk : kOtherBorder, named ? kSetBorder : kThinLine);
  }
  cairo_restore(cr);
  DrawFrame(cr, window);
}

void Overview::DrawAxes(cairo_t* cr) const {
  for (const contour::RingIndex ring : map_.rings) {
    DrawBottomAxis(cr, boundary_, ring, WindowOf({ring, map_.rings.front()}), "u", unit_);
    DrawLeftAxis(cr, boundary_, ring, WindowOf({map_.rings.front(), ring}), "u′", unit_);
  }
}

void Overview::DrawPlan(cairo_t* cr) const {
  SetColor(cr, kInk);
  for (const MapSwitch& step : map_.switches) {
    if (step.shared_axis) {
      SetDash(cr);
    } else {
      SetDots(cr);
    }
    StrokeLine(cr, ToPage(step.from), ToPage(step.to), kSwitchWidth);
  }
  ClearDash(cr);
  for (const SpaceShape& path : map_.paths) {
    const PlotWindow window = WindowOf(path.rings);
    cairo_new_path(cr);
    for (const Vector2d& p : path.points) {
      const Vector2d at = window.ToPage(p);
      cairo_line_to(cr, at.x(), at.y());
    }
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_width(cr, kOverviewPathWidth);
    cairo_stroke(cr);
  }
  for (const SpacePoint& grasp : map_.grasps) DrawDot(cr, ToPage(grasp), kOverviewDotRadius);
}

/// Return whether the largest square of a set has space for its name and no grasp is there.
bool Overview::HasClearanceAt(const MapSet& set, const SpacePoint& place) const {
  const double half = set.largest * WindowOf(place.rings).scale.minCoeff();
  return half >= kMarkRadius && std::ranges::none_of(map_.grasps, [&](const SpacePoint& grasp) {
           return (ToPage(grasp) - ToPage(place)).norm() < kMarkRadius + kOverviewDotRadius;
         });
}

/// Draw the numbers of the grasps and the names of the sets.
void Overview::DrawMarks(cairo_t* cr) const {
  std::vector<std::string> marks;
  std::vector<LabelAnchor> anchors;
  std::vector<Obstacle> obstacles;
  for (std::size_t i = 0; i < map_.grasps.size(); ++i) {
    const Vector2d at = ToPage(map_.grasps[i]);
    marks.push_back(std::to_string(i));
    anchors.push_back({at, Vector2d::Zero()});
    obstacles.push_back({at, at, kOverviewDotRadius, kDotWeight});
  }
  for (const MapSwitch& step : map_.switches) {
    obstacles.push_back({ToPage(step.from), ToPage(step.to), 0, kTravelWeight});
  }
  for (const SpaceShape& path : map_.paths) {
    const PlotWindow window = WindowOf(path.rings);
    for (std::size_t i = 1; i < path.points.size(); ++i) {
      obstacles.push_back(
          {window.ToPage(path.points[i - 1]), window.ToPage(path.points[i]), 0, kTravelWeight});
    }
  }
  for (const MapSet& set : map_.sets) {
    for (const SpacePoint& place : set.label_places) {
      const Vector2d at = ToPage(place);
      if (HasClearanceAt(set, place)) {
        DrawMark(cr, SetName(*set.name), at);
        obstacles.push_back({at, at, kMarkRadius, kDotWeight});
      } else {
        marks.push_back(SetName(*set.name));
        anchors.push_back({at, Vector2d::Zero()});
      }
    }
  }
  const std::vector<Vector2d> centres = PlaceLabels(
      anchors, obstacles, kMarkRadius, static_cast<int>(width()), static_cast<int>(height()));
  for (std::size_t i = 0; i < marks.size(); ++i) DrawMark(cr, marks[i], centres[i]);
}

void Overview::Draw(cairo_t* cr) const {
  for (const contour::RingIndex across : map_.rings) {
    for (const contour::RingIndex up : map_.rings) DrawSets(cr, {across, up});
  }
  DrawAxes(cr);
  DrawPlan(cr);
  DrawMarks(cr);
}

}  // namespace

std::string DrawContactSpace(const contour::Boundary& boundary, const ContactSpaceMap& map,
                             const AxisUnit& unit, const std::string& caption,
                             const FigureStyle& style) {
  const Overview overview(boundary, map, unit);
  return DrawWithCaption(style, {overview.width(), overview.height()}, caption,
                         [&](cairo_t* cr) { overview.Draw(cr); });
}

namespace {

constexpr int kDigits = 3;  ///< significant digits of lengths and angles in captions

std::string OverviewCaption(const ContactSpaceMap& map, double friction_angle) {
  const bool stretching =
      std::ranges::any_of(map.sets, [](const MapSet& set) { return set.stretching; });
  return "contact space, θ = " + FormatShort(Degrees(friction_angle), kDigits) +
         "°: " + std::to_string(map.set_count) + (map.set_count == 1 ? " set" : " sets") +
         " of 2-finger grasps" + (stretching ? " (hatched: stretching)" : "") +
         "; dots: grasps after each step, solid: sliding steps, dashed: finger switches";
}

std::string SwitchCaption(const ContactSwitch& step, const plan::Plan& plan, FingerIndex finger,
                          double place) {
  const auto& [before, after] = step.sides;
  const auto half_width = [&](const ContactSwitchSide& side) {
    return "±" + FormatLength(plan.scale * side.size, kDigits) + " about grasp " +
           std::to_string(side.grasp_entry);
  };
  return PanelLabel(step.entry) + " " + EntryTitle(plan, step.entry) + "; finger " +
         std::to_string(finger) + " stays at " + FormatLength(plan.scale * place, kDigits) +
         "; largest squares: " + half_width(before) + ", " + half_width(after);
}

}  // namespace

ContactSpaceFigures::ContactSpaceFigures(const object::Polygon& polygon, const plan::Plan& plan)
    : plan_(plan),
      graph_(polygon, plan.friction_angle),
      geometry_(graph_),
      track_(TrackPlan(plan)),
      names_(NameSets(geometry_, track_)),
      unit_(UnitOfAxes(graph_.boundary(), plan.scale)) {}

std::string ContactSpaceFigures::DrawOverview(const FigureStyle& style) {
  const ContactSpaceMap map = MapContactSpace(geometry_, track_);
  return DrawContactSpace(graph_.boundary(), map, unit_, OverviewCaption(map, plan_.friction_angle),
                          style);
}

std::optional<std::string> ContactSpaceFigures::DrawSwitch(plan::EntryIndex entry,
                                                           const FigureStyle& style) {
  const auto step = DescribeContactSwitch(geometry_, track_, entry, names_);
  if (!step) return std::nullopt;
  const int axis = *track_[entry].shared_axis;
  const FingerIndex finger = track_[entry].grasp[axis].finger;
  const double place = step->sides[0].grasp.y();
  return DrawContactSwitch(graph_.boundary(), *step, unit_,
                           SwitchCaption(*step, plan_, finger, place), style);
}

}  // namespace regrasp::render
