#include "tests/planner/sets/contour/held_contact.h"

#include <algorithm>
#include <limits>

namespace regrasp::contour {

using Eigen::Vector2d;

namespace {

/// Call work(piece, k) for the pieces of a set whose k-th edge is `edge`.
template <class Work>
void ForEachPieceOn(const ContourGraph& graph, sets::SetIndex set, FaceIndex edge,
                    const Work& work) {
  for (const PieceIndex piece : graph.pieces_of(set)) {
    for (const int k : {0, 1}) {
      if (graph.pieces()[piece].edges[k] == edge) work(piece, k);
    }
  }
}

}  // namespace

std::optional<Section> SectionOf(const std::vector<Vector2d>& outline, int k, double at) {
  Section section = {std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& from = outline[i];
    const Vector2d& to = outline[(i + 1) % outline.size()];
    if ((from[k] < at) == (to[k] < at)) continue;
    const double y = from[1 - k] + (at - from[k]) / (to[k] - from[k]) * (to[1 - k] - from[1 - k]);
    section = {std::min(section.low, y), std::max(section.high, y)};
  }
  if (!(section.low < section.high)) return std::nullopt;
  return section;
}

double SizeOn(const DiagramEdge& edge, double share) {
  return (1 - share) * edge.from_size + share * edge.to_size;
}

HeldContact::Sampled HeldContact::Sample(int samples) const {
  Sampled sampled;
  ForEachPieceOn(geometry_.graph(), set_, edge_, [&](PieceIndex piece, int k) {
    const auto section = SectionOf(geometry_.OutlineOf(piece), k, at_);
    if (!section) return;
    const double step = (section->high - section->low) / samples;
    sampled.spacing = std::max(sampled.spacing, step);
    for (int i = 0; i < samples; ++i) {
      Vector2d p;
      p[k] = at_;
      p[1 - k] = section->low + (i + 0.5) * step;
      sampled.best = std::max(sampled.best, geometry_.MetricOf(set_).SizeAt(p));
    }
  });
  return sampled;
}

double HeldContact::ByDiagram() const {
  double best = 0;
  const std::vector<DiagramEdge>& diagram = geometry_.DiagramOf(set_);
  ForEachPieceOn(geometry_.graph(), set_, edge_, [&](PieceIndex piece, int k) {
    for (const DiagramEdge& edge : diagram) {
      if (edge.piece != piece) continue;
      const auto [low, high] = std::minmax(edge.from[k], edge.to[k]);
      if (at_ < low || at_ > high) continue;
      const double share = low < high ? (at_ - edge.from[k]) / (edge.to[k] - edge.from[k]) : 0;
      best = std::max(best, SizeOn(edge, share));
      if (low == high) best = std::max(best, edge.to_size);
    }
  });
  return best;
}

}  // namespace regrasp::contour
