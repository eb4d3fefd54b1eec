#include "render/figures/contact_space_switch.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "render/figures/contact_space_map.h"
#include "render/figures/figure_page.h"
#include "render/figures/panel_sheet.h"
#include "render/picture/cairo_paint.h"

namespace regrasp::render {

using Eigen::Vector2d;

namespace {

std::optional<ContactSwitchSide> DescribeSide(contour::SetGeometry& geometry,
                                              const AxisGrasp& grasp, int shared_axis,
                                              const std::map<sets::SetIndex, int>& names) {
  const grasp::Contact& shared = grasp[shared_axis].contact;
  const grasp::Contact& other = grasp[1 - shared_axis].contact;
  const auto at = geometry.Locate({shared, other});
  if (!at) return std::nullopt;
  const contour::ContourGraph& graph = geometry.graph();
  const contour::GraspPiece& piece = graph.pieces()[at->piece];
  const int upright = piece.edges[0] == shared.face ? 0 : 1;
  ContactSwitchSide side;
  side.name = names.at(graph.set_of(at->piece));
  side.stretching = piece.stretching;
  side.other_ring = graph.boundary().ring_of(other.face);
  side.set = UnfoldSet(geometry, *at, upright);
  side.grasp = {at->places[1 - upright], at->places[upright]};
  side.size = geometry.SizeAt(*at);
  side.projection = {std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity()};
  for (const Outline& outline : side.set.pieces) {
    for (const Vector2d& p : outline) {
      side.projection.low = std::min(side.projection.low, p.y());
      side.projection.high = std::max(side.projection.high, p.y());
    }
  }
  return side;
}

}  // namespace

std::optional<ContactSwitch> DescribeContactSwitch(contour::SetGeometry& geometry,
                                                   const std::vector<TrackEntry>& track,
                                                   plan::EntryIndex entry,
                                                   const std::map<sets::SetIndex, int>& names) {
  const auto axis = track[entry].shared_axis;
  if (!axis) return std::nullopt;
  ContactSwitch found;
  found.entry = entry;
  found.shared_ring = geometry.graph().boundary().ring_of(track[entry].grasp[*axis].contact.face);
  for (int k = 0; k < 2; ++k) {
    auto side = DescribeSide(geometry, track[entry - 1 + k].grasp, *axis, names);
    if (!side) return std::nullopt;
    side->grasp_entry = plan::EntryIndex(entry - 1 + k);
    found.sides[k] = std::move(*side);
  }
  const contour::PlaceRange& before = found.sides[0].projection;
  const contour::PlaceRange& after = found.sides[1].projection;
  found.overlap = {std::max(before.low, after.low), std::min(before.high, after.high)};
  return found;
}

namespace {

// Lengths in points.
constexpr double kTopSpace = 16;     ///< space for titles
constexpr double kMiddleSpace = 74;  ///< space between the windows for bars
constexpr double kRightSpace = 6;
constexpr double kPadding = 7;     ///< padding around a set in its window
constexpr double kNarrowest = 62;  ///< minimum width of a window without padding
constexpr double kTallest = 120 * kPointsPerMillimetre;
constexpr double kTitleAbove = 5;
constexpr double kBarWidth = 7;
constexpr double kBarDistance = 17;  ///< distance between the middles of bars
constexpr double kDiagramLine = 0.3;
constexpr double kSquareLine = 0.8;
constexpr double kSharedLine = 0.5;
constexpr double kDotRadius = 1.3;
constexpr double kMarkAside = 6.5;   ///< distance from a grasp to its number inside the square
constexpr double kMarkBeyond = 4.5;  ///< distance from the square to a number outside
constexpr double kLargeSquare = 11;  ///< half-width of a square that has space for the number

constexpr Color kDiagramInk = {80, 92, 120};
/// Pale, because the diagram is drawn on top.
constexpr Color kHatchInk = {252, 252, 252};
constexpr Color kBand = {240, 240, 240};

struct SetExtent {
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d high = -low;
};

SetExtent SetExtentOf(const ContactSwitchSide& side) {
  SetExtent extent;
  for (const Outline& outline : side.set.pieces) {
    for (const Vector2d& p : outline) {
      extent.low = extent.low.cwiseMin(p);
      extent.high = extent.high.cwiseMax(p);
    }
  }
  return extent;
}

/// Return the largest scale at which two widths fit, if neither is drawn narrower than kNarrowest.
double FitWidths(double a, double b, double space) {
  const double scale = space / (a + b);
  if (scale * std::min(a, b) >= kNarrowest) return scale;
  return std::min((space - kNarrowest) / std::max(a, b), kNarrowest / std::min(a, b));
}

void DrawSet(cairo_t* cr, const ContactSwitchSide& side, const PlotWindow& window) {
  FillPieces(cr, window, side.set.pieces, PlanSetTint(side.name));
  if (side.stretching) HatchPieces(cr, window, side.set.pieces, kHatchInk);
  StrokeSegments(cr, window, side.set.diagram, kDiagramInk, kDiagramLine);
  StrokeSegments(cr, window, side.set.border, kInk, kSetBorder);
  SetDots(cr);
  StrokeSegments(cr, window, side.set.cuts, kInk, kSetBorder);
  ClearDash(cr);
}

void DrawGrasp(cairo_t* cr, const ContactSwitchSide& side, const PlotWindow& window) {
  const Vector2d at = window.ToPage(side.grasp);
  const double half = side.size * window.scale.x();
  SetBox(cr, at - Vector2d::Constant(half), Vector2d::Constant(2 * half));
  Stroke(cr, kInk, kSquareLine);
  DrawDot(cr, at, kDotRadius);
  // Inside a corner of a large square, or outside the corner of a small one, towards the middle of
  // the window.
  const double aside = half > kLargeSquare ? kMarkAside : half + kMarkBeyond;
  const bool left = at.x() < window.corner.x() + window.size().x() / 2;
  DrawMark(cr, std::to_string(side.grasp_entry), at + Vector2d(left ? aside : -aside, -aside));
}

/// Draw a range of the shared axis as a bar centred at `x`.
void DrawBar(cairo_t* cr, const PlotWindow& window, const contour::PlaceRange& range, double x,
             Color fill, const std::string& name) {
  const double top = window.ToPage({window.low.x(), range.high}).y();
  const double bottom = window.ToPage({window.low.x(), range.low}).y();
  SetBox(cr, {x - kBarWidth / 2, top}, {kBarWidth, bottom - top});
  FillAndStroke(cr, fill, kInk, kSetBorder);
  DrawLabel(cr, name, {x, window.corner.y() - kTitleAbove}, TextAlign::kCentre);
}

void DrawBars(cairo_t* cr, const ContactSwitch& step, const SwitchLayout& layout) {
  const PlotWindow& left = layout.windows[0];
  const double end = left.corner.x() + left.size().x();
  const double middle = (end + layout.windows[1].corner.x()) / 2;
  const std::string before = SetName(step.sides[0].name);
  const std::string after = SetName(step.sides[1].name);
  DrawBar(cr, left, step.sides[0].projection, middle - kBarDistance,
          PlanSetTint(step.sides[0].name), before);
  DrawBar(cr, left, step.overlap, middle, kInk, "both");
  DrawBar(cr, left, step.sides[1].projection, middle + kBarDistance,
          PlanSetTint(step.sides[1].name), after);
}

/// Return the left end of the first window and the right end of the second.
std::array<double, 2> Across(const SwitchLayout& layout) {
  const PlotWindow& right = layout.windows[1];
  return {layout.windows[0].corner.x(), right.corner.x() + right.size().x()};
}

void DrawBand(cairo_t* cr, const ContactSwitch& step, const SwitchLayout& layout) {
  const auto [from, to] = Across(layout);
  const PlotWindow& window = layout.windows[0];
  const double top = window.ToPage({window.low.x(), step.overlap.high}).y();
  const double bottom = window.ToPage({window.low.x(), step.overlap.low}).y();
  SetBox(cr, {from, top}, {to - from, bottom - top});
  Fill(cr, kBand);
}

void DrawSwitch(cairo_t* cr, const contour::Boundary& boundary, const ContactSwitch& step,
                const SwitchLayout& layout, const AxisUnit& unit) {
  DrawBand(cr, step, layout);
  const auto [from, to] = Across(layout);
  for (int k = 0; k < 2; ++k) {
    const PlotWindow& window = layout.windows[k];
    SaveAndClip(cr, window);
    DrawSet(cr, step.sides[k], window);
    cairo_restore(cr);
    DrawFrame(cr, window);
    DrawBottomAxis(cr, boundary, step.sides[k].other_ring, window, "other contact", unit);
    const double middle = window.corner.x() + window.size().x() / 2;
    DrawLabel(cr, std::string(k == 0 ? "before" : "after") + ": set " + SetName(step.sides[k].name),
              {middle, window.corner.y() - kTitleAbove}, TextAlign::kCentre);
  }
  DrawLeftAxis(cr, boundary, step.shared_ring, layout.windows[0], "contact that stays", unit);
  DrawBars(cr, step, layout);
  const double y = layout.windows[0].ToPage(step.sides[0].grasp).y();
  SetColor(cr, kInk);
  SetDash(cr);
  StrokeLine(cr, {from, y}, {to, y}, kSharedLine);
  ClearDash(cr);
  for (int k = 0; k < 2; ++k) DrawGrasp(cr, step.sides[k], layout.windows[k]);
}

}  // namespace

SwitchLayout LayOutSwitch(const ContactSwitch& step) {
  const std::array<SetExtent, 2> extents = {SetExtentOf(step.sides[0]), SetExtentOf(step.sides[1])};
  const double low = std::min(extents[0].low.y(), extents[1].low.y());
  const double high = std::max(extents[0].high.y(), extents[1].high.y());
  const auto width_of = [](const SetExtent& extent) { return extent.high.x() - extent.low.x(); };
  const double space = kTwoColumnWidth - kLeftSpace - kMiddleSpace - kRightSpace - 4 * kPadding;
  const double scale = std::min(FitWidths(width_of(extents[0]), width_of(extents[1]), space),
                                (kTallest - 2 * kPadding) / (high - low));
  SwitchLayout layout;
  double used = 0;
  for (int k = 0; k < 2; ++k) {
    PlotWindow& window = layout.windows[k];
    const double half = std::max(scale * width_of(extents[k]), kNarrowest) / 2 + kPadding;
    const double middle = (extents[k].low.x() + extents[k].high.x()) / 2;
    window.scale = Vector2d::Constant(scale);
    window.low = {middle - half / scale, low - kPadding / scale};
    window.high = {middle + half / scale, high + kPadding / scale};
    used += window.size().x();
  }
  const double unused = kTwoColumnWidth - kLeftSpace - kMiddleSpace - kRightSpace - used;
  layout.windows[0].corner = {kLeftSpace + unused / 2, kTopSpace};
  layout.windows[1].corner = {
      layout.windows[0].corner.x() + layout.windows[0].size().x() + kMiddleSpace, kTopSpace};
  layout.height = kTopSpace + layout.windows[0].size().y() + kBottomSpace;
  return layout;
}

std::string DrawContactSwitch(const contour::Boundary& boundary, const ContactSwitch& step,
                              const AxisUnit& unit, const std::string& caption,
                              const FigureStyle& style) {
  const SwitchLayout layout = LayOutSwitch(step);
  return DrawWithCaption(style, {kTwoColumnWidth, layout.height}, caption,
                         [&](cairo_t* cr) { DrawSwitch(cr, boundary, step, layout, unit); });
}

}  // namespace regrasp::render
