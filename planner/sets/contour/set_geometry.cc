#include "planner/sets/contour/set_geometry.h"

#include <algorithm>
#include <cmath>

#include "planner/grasp/required_friction_angle.h"

namespace regrasp::contour {

using Eigen::Vector2d;

namespace {

double CrossProduct(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Compute twice the area of a convex outline.
double DoubleArea(const std::vector<Vector2d>& outline) {
  double area = 0;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    area += CrossProduct(outline[i] - outline[0], outline[i + 1] - outline[0]);
  }
  return area;
}

/// Map two uniform numbers in [0, 1) to a uniform point of a triangle.
Vector2d PointOfTriangle(const Vector2d& a, const Vector2d& b, const Vector2d& c, double s,
                         double t) {
  if (s + t > 1) return a + (1 - s) * (b - a) + (1 - t) * (c - a);
  return a + s * (b - a) + t * (c - a);
}

}  // namespace

const std::vector<Vector2d>& SetGeometry::OutlineOf(PieceIndex piece) {
  deadline_.Check();
  const auto [known, is_new] = outlines_.try_emplace(piece);
  if (is_new) known->second = PieceOutline(graph_, piece);
  return known->second;
}

const RegionMetric& SetGeometry::MetricOf(sets::SetIndex set) {
  return metrics_.try_emplace(set, graph_, set).first->second;
}

const SetGeometry::Diagram& SetGeometry::FindDiagram(sets::SetIndex set) {
  const auto known = diagrams_.find(set);
  if (known != diagrams_.end()) return known->second;
  Diagram diagram;
  diagram.edges = MetricOf(set).MakeDiagram(deadline_);
  for (const DiagramEdge& edge : diagram.edges) {
    diagram.width = std::max({diagram.width, edge.from_size, edge.to_size});
  }
  return diagrams_.emplace(set, std::move(diagram)).first->second;
}

const std::vector<DiagramEdge>& SetGeometry::DiagramOf(sets::SetIndex set) {
  return FindDiagram(set).edges;
}

double SetGeometry::WidthOf(sets::SetIndex set) { return FindDiagram(set).width; }

double SetGeometry::SizeAt(const PlacedGrasp& grasp) {
  return MetricOf(graph_.set_of(grasp.piece)).SizeAt(grasp.places);
}

double SetGeometry::AngleMarginOf(const PlacedGrasp& grasp) const {
  deadline_.Check();
  const grasp::Grasp contacts = GraspOf(grasp);
  const bool stretching = graph_.pieces()[grasp.piece].stretching;
  const Eigen::Vector3d line = (stretching ? -1 : 1) * (contacts[1].p - contacts[0].p);
  return std::atan(graph_.tangent()) - std::max(grasp::AngleBetween(contacts[0].n, line),
                                                grasp::AngleBetween(contacts[1].n, -line));
}

std::optional<PlaceRange> SetGeometry::RangeOf(PieceIndex piece, int k) {
  const std::vector<Vector2d>& outline = OutlineOf(piece);
  if (outline.empty()) return std::nullopt;
  const auto [low, high] =
      std::ranges::minmax(outline, {}, [&](const Vector2d& p) { return p[k]; });
  if (low[k] >= high[k]) return std::nullopt;
  return PlaceRange{low[k], high[k]};
}

std::optional<PlaceRange> SetGeometry::SliceOf(PieceIndex piece, int k, double place) {
  const std::vector<Vector2d>& outline = OutlineOf(piece);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& a = outline[i];
    const Vector2d& b = outline[(i + 1) % outline.size()];
    if (std::min(a[k], b[k]) > place || std::max(a[k], b[k]) < place) continue;
    const double share = a[k] == b[k] ? 0 : (place - a[k]) / (b[k] - a[k]);
    for (const double at : {share, a[k] == b[k] ? 1 : share}) {
      const double other = a[1 - k] + at * (b[1 - k] - a[1 - k]);
      low = std::min(low, other);
      high = std::max(high, other);
    }
  }
  if (!(low < high)) return std::nullopt;
  return PlaceRange{low, high};
}

std::optional<PlacedGrasp> SetGeometry::Draw(sets::SetIndex set, RandomStream& random) {
  double total = 0;
  for (const PieceIndex piece : graph_.pieces_of(set)) total += DoubleArea(OutlineOf(piece));
  double left = total * random.Uniform();
  const double s = random.Uniform();
  const double t = random.Uniform();
  for (const PieceIndex piece : graph_.pieces_of(set)) {
    const std::vector<Vector2d>& outline = OutlineOf(piece);
    for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
      left -= CrossProduct(outline[i] - outline[0], outline[i + 1] - outline[0]);
      if (left < 0) {
        return PlacedGrasp{piece, PointOfTriangle(outline[0], outline[i], outline[i + 1], s, t)};
      }
    }
  }
  return std::nullopt;
}

std::optional<PlacedGrasp> SetGeometry::Locate(const grasp::Grasp& grasp) const {
  const Boundary& boundary = graph_.boundary();
  const bool ascending = grasp[0].face < grasp[1].face;
  const grasp::Contact& first = grasp[ascending ? 0 : 1];
  const grasp::Contact& second = grasp[ascending ? 1 : 0];
  const bool stretching = first.n.dot(second.p - first.p) < 0;
  for (const PieceIndex piece : graph_.PiecesOn(first.face, second.face)) {
    if (graph_.pieces()[piece].stretching != stretching) continue;
    return PlacedGrasp{piece, {boundary.PlaceOf(first), boundary.PlaceOf(second)}};
  }
  return std::nullopt;
}

grasp::Grasp SetGeometry::GraspOf(const PlacedGrasp& grasp) const {
  const auto& [a, b] = graph_.pieces()[grasp.piece].edges;
  const Boundary& boundary = graph_.boundary();
  return {boundary.ContactAt(a, grasp.places[0]), boundary.ContactAt(b, grasp.places[1])};
}

}  // namespace regrasp::contour
