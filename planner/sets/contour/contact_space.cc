#include "planner/sets/contour/contact_space.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace regrasp::contour {

using Eigen::Vector2d;

namespace {

/// Length below which a part of a border is rounding, divided by the boundary's length.
constexpr double kRounding = 1e-12;

/// Function at + dx · x + dy · y of the places on two edges, relative to the starts of the edges.
struct LinearForm {
  double at = 0;
  double dx = 0;
  double dy = 0;

  [[nodiscard]] double operator()(const Vector2d& p) const { return at + dx * p.x() + dy * p.y(); }
};

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Return the four forms that are positive on a piece: distances of a contact from the borders of
/// the other contact's cone. A form increases in both places or decreases in both, so its zero line
/// has dy/dx < 0.
std::array<LinearForm, 4> PieceForms(const ContourGraph& graph, const GraspPiece& piece) {
  const object::Polygon& polygon = graph.boundary().polygon();
  const double angle = std::atan(graph.tangent());
  const double sign = piece.stretching ? -1 : 1;
  std::array<Vector2d, 2> starts, along;
  std::array<Vector2d, 4> borders;  // the right borders, and the reversed left ones
  for (int k = 0; k < 2; ++k) {
    const auto [from, to] = polygon.edge(piece.edges[k]);
    starts[k] = from.head<2>();
    along[k] = (to - from).head<2>() / polygon.face_measure(piece.edges[k]);
    const Vector2d normal(-along[k].y(), along[k].x());
    const double side = k == 0 ? sign : -sign;
    borders[2 * k] = side * (std::cos(angle) * normal + std::sin(angle) * along[k]);
    borders[2 * k + 1] = -side * (std::cos(angle) * normal - std::sin(angle) * along[k]);
  }
  std::array<LinearForm, 4> forms;
  for (int i = 0; i < 4; ++i) {
    forms[i] = {Cross(borders[i], starts[1] - starts[0]), -Cross(borders[i], along[0]),
                Cross(borders[i], along[1])};
  }
  return forms;
}

/// Return the length below which differences are rounding, at a piece.
double Rounding(const ContourGraph& graph, const GraspPiece& piece) {
  const Boundary& boundary = graph.boundary();
  return kRounding * std::max(boundary.perimeter(boundary.ring_of(piece.edges[0])),
                              boundary.perimeter(boundary.ring_of(piece.edges[1])));
}

/// Corner of an outline, and whether the side after it is a line that cuts the piece.
struct TaggedCorner {
  Vector2d p;
  bool cut_after = false;
};

/// Return the part of a convex outline with a positive form. Corners that are outside only by
/// rounding are kept: for parallel edges two lines coincide, and the second one must not cut again.
std::vector<TaggedCorner> Clip(const std::vector<TaggedCorner>& outline, const LinearForm& form,
                               double rounding) {
  std::vector<TaggedCorner> clipped;
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const TaggedCorner& a = outline[i];
    const TaggedCorner& b = outline[(i + 1) % n];
    const double at_a = form(a.p);
    const double at_b = form(b.p);
    const bool has_a = at_a > -rounding;
    if (has_a) clipped.push_back(a);
    if (has_a == (at_b > -rounding)) continue;
    const double share = std::clamp(at_a / (at_a - at_b), 0.0, 1.0);
    clipped.push_back({a.p + share * (b.p - a.p), has_a ? true : a.cut_after});
  }
  return clipped;
}

/// Drop sides whose length is rounding, because their directions are meaningless.
void DropShortSides(std::vector<TaggedCorner>& outline, double rounding) {
  std::vector<TaggedCorner> kept;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d side = outline[(i + 1) % outline.size()].p - outline[i].p;
    if (side.lpNorm<Eigen::Infinity>() > rounding) kept.push_back(outline[i]);
  }
  outline = std::move(kept);
}

/// Return the outline of a piece in places relative to the starts of its edges.
std::vector<TaggedCorner> LocalOutline(const ContourGraph& graph, const GraspPiece& piece) {
  const object::Polygon& polygon = graph.boundary().polygon();
  const double width = polygon.face_measure(piece.edges[0]);
  const double height = polygon.face_measure(piece.edges[1]);
  std::vector<TaggedCorner> outline = {{{0, 0}}, {{width, 0}}, {{width, height}}, {{0, height}}};
  if (piece.full) return outline;
  const double rounding = Rounding(graph, piece);
  for (const LinearForm& form : PieceForms(graph, piece)) outline = Clip(outline, form, rounding);
  DropShortSides(outline, rounding);
  return outline;
}

Vector2d Origin(const ContourGraph& graph, const GraspPiece& piece) {
  return {graph.boundary().begin(piece.edges[0]), graph.boundary().begin(piece.edges[1])};
}

/// Return the places of the other contact if the contact on the k-th edge is at its start or end;
/// nullopt if doubles find none.
std::optional<PlaceRange> SideRange(const ContourGraph& graph, const GraspPiece& piece, int k,
                                    bool at_end) {
  const object::Polygon& polygon = graph.boundary().polygon();
  const FaceIndex other = piece.edges[1 - k];
  const double length = polygon.face_measure(other);
  PlaceRange range = {0, length};
  if (!piece.full) {
    Vector2d from = Vector2d::Zero();
    if (at_end) from[k] = polygon.face_measure(piece.edges[k]);
    Vector2d to = from;
    to[1 - k] = length;
    for (const LinearForm& form : PieceForms(graph, piece)) {
      const double first = form(from);
      const double last = form(to);
      if (first <= 0 && last <= 0) return std::nullopt;
      const double crossing = length * first / (first - last);
      if (first <= 0) range.low = std::max(range.low, crossing);
      if (last <= 0) range.high = std::min(range.high, crossing);
    }
  }
  if (range.low >= range.high) return std::nullopt;
  const double begin = graph.boundary().begin(other);
  return PlaceRange{begin + range.low, begin + range.high};
}

/// Computes the border of one set.
class BorderFinder {
 public:
  BorderFinder(const ContourGraph& graph, sets::SetIndex set)
      : graph_(graph), rounding_(Rounding(graph, graph.pieces()[graph.pieces_of(set).front()])) {
    for (const PieceIndex piece : graph.pieces_of(set)) {
      AddCuts(piece);
      for (int k = 0; k < 2; ++k) {
        AddSide(piece, k, false);
        AddSide(piece, k, true);
      }
    }
    for (auto& [line, parts] : lines_) AddLine(line, parts);
  }

  [[nodiscard]] std::vector<BorderSegment> Take() { return std::move(border_); }

 private:
  /// Line that contains sides of pieces: the start or end of the edge of the k-th contact.
  struct Line {
    FaceIndex edge;
    int k;
    bool at_end;
    auto operator<=>(const Line&) const = default;
  };
  struct Part {
    PlaceRange range;
    PieceIndex piece;
  };

  void AddCuts(PieceIndex piece) {
    const GraspPiece& p = graph_.pieces()[piece];
    const std::vector<TaggedCorner> outline = LocalOutline(graph_, p);
    const Vector2d origin = Origin(graph_, p);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      if (!outline[i].cut_after) continue;
      const Vector2d& to = outline[(i + 1) % outline.size()].p;
      if ((to - outline[i].p).lpNorm<Eigen::Infinity>() <= rounding_) continue;
      border_.push_back({origin + outline[i].p, origin + to, piece});
    }
  }

  /// Add the part of a piece's side that is not a side of the adjacent piece.
  void AddSide(PieceIndex piece, int k, bool at_end) {
    const GraspPiece& p = graph_.pieces()[piece];
    const auto range = SideRange(graph_, p, k, at_end);
    if (!range) return;
    std::vector<Part>& parts = lines_[{p.edges[k], k, at_end}];
    const auto add = [&](double low, double high) {
      if (high - low > rounding_) parts.push_back({{low, high}, piece});
    };
    const auto beyond = RangeBeyond(piece, k, at_end);
    if (!beyond) return add(range->low, range->high);
    add(range->low, std::min(range->high, beyond->low));
    add(std::max(range->low, beyond->high), range->high);
  }

  /// Return the same side of the adjacent piece; nullopt if the two do not meet.
  [[nodiscard]] std::optional<PlaceRange> RangeBeyond(PieceIndex piece, int k, bool at_end) const {
    const FaceIndex edge = graph_.pieces()[piece].edges[k];
    for (const PassageIndex i : graph_.passages_at(piece)) {
      const PiecePassage& passage = graph_.passages()[i];
      if (passage.pieces[at_end ? 0 : 1] != piece) continue;
      const FaceIndex turning = at_end ? passage.edge : graph_.boundary().next(passage.edge);
      if (turning != edge) continue;
      const GraspPiece& beyond = graph_.pieces()[passage.pieces[at_end ? 1 : 0]];
      return SideRange(graph_, beyond, beyond.edges[0] == passage.other ? 1 : 0, !at_end);
    }
    return std::nullopt;
  }

  /// Add the parts on a line; consecutive parts are joined.
  void AddLine(const Line& line, std::vector<Part>& parts) {
    std::ranges::sort(parts, {}, [](const Part& part) { return part.range.low; });
    const Boundary& boundary = graph_.boundary();
    const double place = line.at_end ? boundary.end(line.edge) : boundary.begin(line.edge);
    for (std::size_t i = 0; i < parts.size();) {
      Part joined = parts[i++];
      for (; i < parts.size() && parts[i].range.low <= joined.range.high + rounding_; ++i) {
        joined.range.high = std::max(joined.range.high, parts[i].range.high);
      }
      BorderSegment segment;
      segment.piece = joined.piece;
      segment.from[line.k] = segment.to[line.k] = place;
      segment.from[1 - line.k] = joined.range.low;
      segment.to[1 - line.k] = joined.range.high;
      border_.push_back(segment);
    }
  }

  const ContourGraph& graph_;
  double rounding_;
  std::map<Line, std::vector<Part>> lines_;
  std::vector<BorderSegment> border_;
};

}  // namespace

std::vector<Vector2d> PieceOutline(const ContourGraph& graph, PieceIndex piece) {
  const GraspPiece& p = graph.pieces()[piece];
  const Vector2d origin = Origin(graph, p);
  std::vector<Vector2d> outline;
  for (const TaggedCorner& corner : LocalOutline(graph, p)) outline.push_back(origin + corner.p);
  if (outline.size() < 3) outline.clear();
  return outline;
}

std::vector<BorderSegment> SetBorder(const ContourGraph& graph, sets::SetIndex set) {
  return BorderFinder(graph, set).Take();
}

PlaceRange PassageRange(const ContourGraph& graph, const PiecePassage& passage) {
  const auto range = [&](PieceIndex piece, bool at_end) {
    const GraspPiece& p = graph.pieces()[piece];
    const auto found = SideRange(graph, p, p.edges[0] == passage.other ? 1 : 0, at_end);
    const Boundary& boundary = graph.boundary();
    return found.value_or(PlaceRange{boundary.begin(passage.other), boundary.end(passage.other)});
  };
  const PlaceRange before = range(passage.pieces[0], true);
  const PlaceRange after = range(passage.pieces[1], false);
  const double low = std::max(before.low, after.low);
  const double high = std::min(before.high, after.high);
  if (low < high) return {low, high};
  return {(low + high) / 2, (low + high) / 2};
}

}  // namespace regrasp::contour
