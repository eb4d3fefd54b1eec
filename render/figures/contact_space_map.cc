#include "render/figures/contact_space_map.h"

#include <cairo.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <set>
#include <string_view>

#include "planner/base/number.h"
#include "render/figures/contact_space_track.h"
#include "render/figures/figure_page.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/caption.h"
#include "render/picture/image.h"

namespace regrasp::render {

using Eigen::Vector2d;

namespace {

// Lengths in points.
constexpr double kVertexTick = 2;
constexpr double kLabelTick = 4;
constexpr double kTickWidth = 0.35;
constexpr double kFrameWidth = 0.5;
constexpr double kLabelDistance = 2;  ///< distance from tick to label
constexpr double kBelowGap = 28;      ///< minimum distance of labels below a plot
constexpr double kBesideGap = 16;     ///< minimum distance of labels next to a plot
constexpr double kTitleBelow = 23;    ///< distance from a plot to the base of the title below it
constexpr double kTitleBeside = 36;   ///< distance from a plot to the title next to it

constexpr int kVertexDigits = 3;
/// Number of vertices above which round lengths are easier to read.
constexpr int kFewVertices = 8;

/// Relative difference of positions that are equal up to rounding.
constexpr double kRounding = 1e-9;

struct Vertex {
  double place;   ///< position on the axis
  double length;  ///< length on the ring
  bool begins;    ///< whether the ring starts here
};

std::vector<Vertex> ShownVertices(const contour::Boundary& boundary, contour::RingIndex ring,
                                  const contour::PlaceRange& shown) {
  const double perimeter = boundary.perimeter(ring);
  const double slack = kRounding * perimeter;
  std::vector<Vertex> vertices;
  for (double turn = std::floor(shown.low / perimeter); turn * perimeter <= shown.high; ++turn) {
    for (FaceIndex edge = boundary.first_edge(ring); edge < boundary.end_edge(ring); ++edge) {
      const double length = boundary.begin(edge);
      const double place = turn * perimeter + length;
      if (place < shown.low - slack || place > shown.high + slack) continue;
      vertices.push_back({place, length, edge == boundary.first_edge(ring)});
    }
  }
  return vertices;
}

std::string LengthLabel(double length) { return FormatShort(length, kVertexDigits); }

/// Return the label at the start of a ring: the perimeter at the end of an axis over one period, 0
/// otherwise.
std::string BeginLabel(const contour::Boundary& boundary, contour::RingIndex ring,
                       const contour::PlaceRange& shown, double place, const AxisUnit& unit) {
  const double perimeter = boundary.perimeter(ring);
  const double slack = kRounding * perimeter;
  const bool end = place > perimeter / 2 && shown.low >= -slack && shown.high <= perimeter + slack;
  return end ? LengthLabel(unit.per_unit * perimeter) : "0";
}

/// Remove vertices that print cannot separate, except the starts of rings.
std::vector<Vertex> Thin(const std::vector<Vertex>& vertices, double gap) {
  std::vector<Vertex> kept;
  for (const Vertex& vertex : vertices) {
    while (vertex.begins && !kept.empty() && !kept.back().begins &&
           vertex.place - kept.back().place < gap) {
      kept.pop_back();
    }
    if (vertex.begins || kept.empty() || vertex.place - kept.back().place >= gap) {
      kept.push_back(vertex);
    }
  }
  return kept;
}

/// Return whether vertices are few, far apart and have distinct labels.
bool CanBeLabelled(const std::vector<Vertex>& vertices, double gap) {
  if (vertices.size() < 2 || vertices.size() > kFewVertices) return false;
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    const Vertex& before = vertices[i - 1];
    if (vertices[i].place - before.place < gap) return false;
    if (LengthLabel(vertices[i].length) == LengthLabel(before.length)) return false;
  }
  return true;
}

/// Return the shortest length of the form 1, 2 or 5 times a power of ten that is at least `least`.
double RoundLengthAbove(double least) {
  // The ratio of consecutive round lengths is 2 or 2.5.
  const double step = RoundLength(2 * least);
  return step >= least ? step : RoundLength(2.5 * least);
}

/// Return ticks at round lengths, except near the start of the ring.
std::vector<AxisTick> RoundTicks(double perimeter, const contour::PlaceRange& shown, double gap,
                                 const AxisUnit& unit) {
  const double labelled = RoundLengthAbove(unit.per_unit * gap);
  const double step = labelled / unit.per_unit;
  // Enough digits to distinguish the largest length from the previous tick, and all digits before
  // the decimal point.
  const int first = static_cast<int>(std::floor(std::log10(unit.per_unit * perimeter)));
  const int digits = 1 + first - std::min(static_cast<int>(std::floor(std::log10(labelled))), 0);
  std::vector<AxisTick> ticks;
  for (double turn = std::floor(shown.low / perimeter); turn * perimeter <= shown.high; ++turn) {
    for (double k = 1; k * step <= perimeter - gap; ++k) {
      const double place = turn * perimeter + k * step;
      if (place >= shown.low && place <= shown.high)
        ticks.push_back({place, FormatShort(k * labelled, std::max(digits, 1))});
    }
  }
  return ticks;
}

}  // namespace

std::vector<AxisTick> MakeTicks(const contour::Boundary& boundary, contour::RingIndex ring,
                                const contour::PlaceRange& shown, double points_per_unit,
                                double label_gap, const AxisUnit& unit) {
  assert(points_per_unit > 0 && shown.low < shown.high);
  const double gap = label_gap / points_per_unit;
  const std::vector<Vertex> vertices = ShownVertices(boundary, ring, shown);
  const bool all = CanBeLabelled(vertices, gap);
  std::vector<AxisTick> ticks;
  if (!all) ticks = RoundTicks(boundary.perimeter(ring), shown, gap, unit);
  for (const Vertex& vertex : Thin(vertices, kTickGap / points_per_unit)) {
    std::string label;
    if (vertex.begins) {
      label = BeginLabel(boundary, ring, shown, vertex.place, unit);
    } else if (all) {
      label = LengthLabel(unit.per_unit * vertex.length);
    }
    ticks.push_back({vertex.place, label});
  }
  std::ranges::stable_sort(ticks, {}, &AxisTick::place);
  return ticks;
}

AxisUnit UnitOfAxes(const contour::Boundary& boundary, double metres_per_unit) {
  double longest = 0;
  for (contour::RingIndex ring{0}; ring < boundary.ring_count(); ++ring) {
    longest = std::max(longest, boundary.perimeter(ring));
  }
  const LengthUnit unit = UnitOfLength(metres_per_unit * longest);
  return {metres_per_unit / unit.metres, unit.name};
}

std::string AxisTitle(const contour::Boundary& boundary, const std::string& length,
                      contour::RingIndex ring, const AxisUnit& unit) {
  std::string title = length;
  if (boundary.ring_count() > 1) {
    title += ring == 0 ? ", outer ring" : ", hole " + std::to_string(ring);
  }
  return unit.name.empty() ? title : title + " (" + unit.name + ")";
}

void DrawBottomAxis(cairo_t* cr, const contour::Boundary& boundary, contour::RingIndex ring,
                    const PlotWindow& window, const std::string& length, const AxisUnit& unit) {
  const double bottom = window.corner.y() + window.size().y();
  SetColor(cr, kInk);
  for (const AxisTick& tick : MakeTicks(boundary, ring, {window.low.x(), window.high.x()},
                                        window.scale.x(), kBelowGap, unit)) {
    const double x = window.ToPage({tick.place, window.low.y()}).x();
    const double tick_length = tick.label.empty() ? kVertexTick : kLabelTick;
    StrokeLine(cr, {x, bottom}, {x, bottom + tick_length}, kTickWidth);
    const Vector2d base(x, bottom + kLabelTick + kLabelDistance + kLabelFont);
    DrawLabel(cr, tick.label, base, TextAlign::kCentre);
  }
  const std::string title = AxisTitle(boundary, length, ring, unit);
  // The page can end at the right border of the plot.
  const double width = std::max(window.size().x(), LabelWidth(cr, title));
  const Vector2d middle(window.corner.x() + window.size().x() - width / 2, bottom + kTitleBelow);
  DrawLabel(cr, title, middle, TextAlign::kCentre);
}

void DrawLeftAxis(cairo_t* cr, const contour::Boundary& boundary, contour::RingIndex ring,
                  const PlotWindow& window, const std::string& length, const AxisUnit& unit) {
  const double left = window.corner.x();
  SetColor(cr, kInk);
  for (const AxisTick& tick : MakeTicks(boundary, ring, {window.low.y(), window.high.y()},
                                        window.scale.y(), kBesideGap, unit)) {
    const double y = window.ToPage({window.low.x(), tick.place}).y();
    const double tick_length = tick.label.empty() ? kVertexTick : kLabelTick;
    StrokeLine(cr, {left, y}, {left - tick_length, y}, kTickWidth);
    // Height of digits per font size, to centre them at the tick.
    constexpr double kDigitShare = 0.36;
    const Vector2d base(left - kLabelTick - kLabelDistance, y + kDigitShare * kLabelFont);
    DrawLabel(cr, tick.label, base, TextAlign::kRight);
  }
  cairo_save(cr);
  cairo_translate(cr, left - kTitleBeside, window.corner.y() + window.size().y() / 2);
  cairo_rotate(cr, -std::numbers::pi / 2);
  DrawLabel(cr, AxisTitle(boundary, length, ring, unit), {0, 0}, TextAlign::kCentre);
  cairo_restore(cr);
}

void DrawFrame(cairo_t* cr, const PlotWindow& window) {
  SetBox(cr, window.corner, window.size());
  Stroke(cr, kInk, kFrameWidth);
}

namespace {

Vector2d Mirrored(const Vector2d& p) { return {p.y(), p.x()}; }

SpaceShape Mirrored(const SpaceShape& shape) {
  SpaceShape mirrored = {{shape.rings[1], shape.rings[0]}, {}};
  for (const Vector2d& p : shape.points) mirrored.points.push_back(Mirrored(p));
  return mirrored;
}

void AddBoth(const SpaceShape& shape, std::vector<SpaceShape>& shapes) {
  shapes.push_back(shape);
  shapes.push_back(Mirrored(shape));
}

std::array<contour::RingIndex, 2> RingsOf(const contour::ContourGraph& graph, sets::SetIndex set) {
  const auto& edges = graph.pieces()[graph.pieces_of(set).front()].edges;
  return {graph.boundary().ring_of(edges[0]), graph.boundary().ring_of(edges[1])};
}

/// The largest square in a set, at the end of an edge of its diagram; size 0 if there is none.
struct LargestSquare {
  Vector2d centre = Vector2d::Zero();
  double size = 0;
};

LargestSquare FindLargest(const std::vector<contour::DiagramEdge>& diagram) {
  LargestSquare largest;
  for (const contour::DiagramEdge& edge : diagram) {
    if (edge.from_size > largest.size) largest = {edge.from, edge.from_size};
    if (edge.to_size > largest.size) largest = {edge.to, edge.to_size};
  }
  return largest;
}

MapSet MakeSet(contour::SetGeometry& geometry, sets::SetIndex set, std::optional<int> name) {
  const contour::ContourGraph& graph = geometry.graph();
  MapSet made;
  made.set = set;
  made.name = name;
  made.stretching = graph.pieces()[graph.pieces_of(set).front()].stretching;
  const auto rings = RingsOf(graph, set);
  for (const contour::PieceIndex piece : graph.pieces_of(set)) {
    const std::vector<Vector2d>& outline = geometry.OutlineOf(piece);
    if (!outline.empty()) AddBoth({rings, outline}, made.pieces);
  }
  for (const contour::BorderSegment& segment : contour::SetBorder(graph, set)) {
    AddBoth({rings, {segment.from, segment.to}}, made.border);
  }
  if (!name) return made;
  const auto [centre, size] = FindLargest(geometry.DiagramOf(set));
  made.largest = size;
  if (size > 0) made.label_places = {{rings, centre}, {{rings[1], rings[0]}, Mirrored(centre)}};
  return made;
}

/// Add the path of a sliding step, split at moves of a contact from the last edge of a ring to the
/// first. A larger jump than half the perimeter identifies this, because no edge is that long.
void AddPath(const contour::Boundary& boundary, const std::vector<AxisGrasp>& path,
             std::vector<SpaceShape>& paths) {
  SpaceShape shape;
  const auto finish = [&] {
    if (shape.points.size() > 1) paths.push_back(shape);
    shape.points.clear();
  };
  for (const AxisGrasp& grasp : path) {
    const SpacePoint at = PointOf(boundary, grasp);
    for (int axis = 0; !shape.points.empty() && axis < 2; ++axis) {
      const double jump = std::abs(at.places[axis] - shape.points.back()[axis]);
      if (jump > boundary.perimeter(at.rings[axis]) / 2) finish();
    }
    shape.rings = at.rings;
    shape.points.push_back(at.places);
  }
  finish();
}

}  // namespace

std::string SetName(int k) {
  constexpr int kLetters = 26;
  std::string letters;
  for (int remaining = k; remaining >= 0; remaining = remaining / kLetters - 1) {
    letters.insert(letters.begin(), static_cast<char>('A' + remaining % kLetters));
  }
  return letters;
}

std::map<sets::SetIndex, int> NameSets(const contour::SetGeometry& geometry,
                                       const std::vector<TrackEntry>& track) {
  std::map<sets::SetIndex, int> names;
  for (const TrackEntry& entry : track) {
    const auto at = geometry.Locate({entry.grasp[0].contact, entry.grasp[1].contact});
    if (!at) continue;
    names.try_emplace(geometry.graph().set_of(at->piece), static_cast<int>(names.size()));
  }
  return names;
}

ContactSpaceMap MapContactSpace(contour::SetGeometry& geometry,
                                const std::vector<TrackEntry>& track) {
  const contour::ContourGraph& graph = geometry.graph();
  ContactSpaceMap map;
  map.set_count = graph.vertex_count();
  std::set<contour::RingIndex> used;
  for (std::size_t i = 0; i < track.size(); ++i) {
    const TrackEntry& entry = track[i];
    map.grasps.push_back(PointOf(graph.boundary(), entry.grasp));
    used.insert(map.grasps.back().rings.begin(), map.grasps.back().rings.end());
    AddPath(graph.boundary(), entry.path, map.paths);
    if (entry.kind == std::string_view("switch")) {
      map.switches.push_back({map.grasps[i - 1], map.grasps[i], entry.shared_axis});
    }
  }
  map.rings.assign(used.begin(), used.end());
  const std::map<sets::SetIndex, int> names = NameSets(geometry, track);
  for (sets::SetIndex set{0}; set < graph.vertex_count(); ++set) {
    const auto rings = RingsOf(graph, set);
    if (!used.contains(rings[0]) || !used.contains(rings[1])) continue;
    const auto name = names.find(set);
    map.sets.push_back(
        MakeSet(geometry, set, name == names.end() ? std::nullopt : std::optional(name->second)));
  }
  return map;
}

namespace {

// Lengths in points.
/// Steeper than most lines of a set.
constexpr Hatch kHatch = {.slope = 2, .spacing = 2.4, .width = 0.3};
constexpr double kDash = 2.4;
constexpr double kDotDash = 0.8;

void AddPieces(cairo_t* cr, const PlotWindow& window, std::span<const Outline> pieces) {
  cairo_new_path(cr);
  cairo_set_fill_rule(cr, CAIRO_FILL_RULE_WINDING);
  std::vector<Vector2d> points;
  for (const Outline& outline : pieces) {
    points.clear();
    for (const Vector2d& p : outline) points.push_back(window.ToPage(p));
    AddOutline(cr, points);
  }
}

}  // namespace

Color PlanSetTint(int index) {
  static constexpr std::array<Color, 6> kTints = {{
      {128, 177, 218},  // blue
      {247, 206, 108},  // amber
      {150, 214, 176},  // green
      {204, 148, 186},  // mauve
      {240, 160, 124},  // coral
      {178, 172, 224},  // violet
  }};
  return kTints[index % kTints.size()];
}

Color OtherSetTint(sets::SetIndex set) {
  static constexpr std::array<unsigned char, 3> kGreys = {224, 236, 213};
  const unsigned char grey = kGreys[set % kGreys.size()];
  return {grey, grey, grey};
}

void SaveAndClip(cairo_t* cr, const PlotWindow& window) {
  cairo_save(cr);
  SetBox(cr, window.corner, window.size());
  cairo_clip(cr);
}

void FillPieces(cairo_t* cr, const PlotWindow& window, std::span<const Outline> pieces,
                Color color) {
  AddPieces(cr, window, pieces);
  Fill(cr, color);
}

void HatchPieces(cairo_t* cr, const PlotWindow& window, std::span<const Outline> pieces,
                 Color color) {
  if (pieces.empty()) return;
  cairo_save(cr);
  AddPieces(cr, window, pieces);
  cairo_clip(cr);
  DrawHatch(cr, window.corner, window.size(), kHatch, color);
  cairo_restore(cr);
}

void StrokeSegments(cairo_t* cr, const PlotWindow& window, std::span<const Segment> segments,
                    Color color, double width) {
  cairo_new_path(cr);
  for (const Segment& segment : segments) {
    const Vector2d a = window.ToPage(segment[0]);
    const Vector2d b = window.ToPage(segment[1]);
    cairo_move_to(cr, a.x(), a.y());
    cairo_line_to(cr, b.x(), b.y());
  }
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
  Stroke(cr, color, width);
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
}

void SetDash(cairo_t* cr) { cairo_set_dash(cr, &kDash, 1, 0); }

void SetDots(cairo_t* cr) { cairo_set_dash(cr, &kDotDash, 1, 0); }

void ClearDash(cairo_t* cr) { cairo_set_dash(cr, nullptr, 0, 0); }

}  // namespace regrasp::render
