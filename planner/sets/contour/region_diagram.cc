#include "planner/sets/contour/region_diagram.h"

#include <algorithm>
#include <array>
#include <limits>

namespace regrasp::contour {

using Eigen::Vector2d;

namespace {

using Site = RegionMetric::Site;

/// Difference below which lengths and sizes are equal, divided by the boundary's length.
constexpr double kDiagramRounding = 1e-12;

/// Limits of subdivision: a box is split until only a few sites can be nearest in it, or until
/// several splits in a row have excluded none. The latter happens at a vertex of the diagram at
/// which more sites meet.
constexpr std::size_t kFewSites = 6;
constexpr int kVainHalvings = 4;

/// Linear function g · x + c.
struct Term {
  Vector2d g = Vector2d::Zero();
  double c = 0;

  [[nodiscard]] double operator()(const Vector2d& x) const { return g.dot(x) + c; }
};

/// Return the distance to a site: the largest of its terms. A centred square of this half-width
/// touches the site.
double Distance(const Site& site, const Vector2d& x) {
  const Vector2d beyond = (x - site.high).cwiseMax(site.low - x);
  const double box = beyond.maxCoeff();
  if (site.normal.x() == 0) return box;
  return std::max(box, std::abs(site.normal.dot(x) - site.offset));
}

std::vector<Term> TermsOf(const Site& site) {
  std::vector<Term> terms = {{{1, 0}, -site.high.x()},
                             {{-1, 0}, site.low.x()},
                             {{0, 1}, -site.high.y()},
                             {{0, -1}, site.low.y()}};
  if (site.normal.x() != 0) {
    terms.push_back({site.normal, -site.offset});
    terms.push_back({-site.normal, site.offset});
  }
  return terms;
}

struct Box {
  Vector2d low;
  Vector2d high;

  [[nodiscard]] Vector2d centre() const { return (low + high) / 2; }
  [[nodiscard]] Vector2d half() const { return (high - low) / 2; }
  void Include(const Box& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
};

Box BoxOf(const std::vector<Vector2d>& outline) {
  Box box = {outline.front(), outline.front()};
  for (const Vector2d& p : outline) box.Include({p, p});
  return box;
}

/// Part of a line: from + t · direction for t in [low, high].
struct LinePart {
  Vector2d from;
  Vector2d direction;
  double low;
  double high;

  [[nodiscard]] Vector2d At(double t) const { return from + t * direction; }

  /// Keep the part with a non-negative term.
  void Clip(const Term& term) {
    const double at = term(from);
    const double slope = term.g.dot(direction);
    if (slope > 0) {
      low = std::max(low, -at / slope);
    } else if (slope < 0) {
      high = std::min(high, -at / slope);
    } else if (at < 0) {
      high = low - 1;
    }
  }
  [[nodiscard]] bool empty() const { return high <= low; }
};

Term operator-(const Term& a, const Term& b) { return {a.g - b.g, a.c - b.c}; }

Term Raise(Term term, double by) {
  term.c += by;
  return term;
}

/// Return the terms of a site that are its distance somewhere in a box.
std::vector<Term> ActiveTerms(const Site& site, const Box& box) {
  const std::vector<Term> terms = TermsOf(site);
  const Vector2d centre = box.centre();
  const Vector2d half = box.half();
  std::vector<Term> active;
  for (const Term& term : terms) {
    const bool hidden = std::ranges::any_of(terms, [&](const Term& other) {
      const Term over = term - other;
      return over(centre) + over.g.cwiseAbs().dot(half) < 0;
    });
    if (!hidden) active.push_back(term);
  }
  return active;
}

/// Computes the diagram of one set, piece by piece.
class DiagramMaker {
 public:
  /// @param deadline  must outlive this object.
  DiagramMaker(const ContourGraph& graph, const std::vector<Site>& sites, double rounding,
               const Deadline& deadline)
      : graph_(graph), sites_(sites), rounding_(rounding), deadline_(deadline) {}

  std::vector<DiagramEdge> Make(std::span<const PieceIndex> pieces) {
    std::vector<Part> parts;
    for (const PieceIndex piece : pieces) {
      deadline_.Check();
      std::vector<Vector2d> outline = PieceOutline(graph_, piece);
      if (outline.empty()) continue;
      const Box box = BoxOf(outline);
      parts.push_back({piece, std::move(outline), box});
    }
    std::vector<int> all(sites_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    if (!parts.empty()) SplitParts(parts, all);
    return std::move(edges_);
  }

 private:
  struct Part {
    PieceIndex piece;
    std::vector<Vector2d> outline;
    Box box;
  };

  /// Return the sites that can be nearest somewhere in a box. A distance changes at most by the
  /// displacement of the point.
  [[nodiscard]] std::vector<int> NearIn(const Box& box, const std::vector<int>& sites) {
    deadline_.Check();
    const Vector2d centre = box.centre();
    double least = std::numeric_limits<double>::infinity();
    distances_.clear();
    for (const int site : sites) {
      distances_.push_back(Distance(sites_[site], centre));
      least = std::min(least, distances_.back());
    }
    const double reach = least + 2 * box.half().maxCoeff() + rounding_;
    std::vector<int> near;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (distances_[i] <= reach) near.push_back(sites[i]);
    }
    return near;
  }

  void SplitParts(std::span<Part> parts, const std::vector<int>& sites) {
    Box box = parts.front().box;
    for (const Part& part : parts) box.Include(part.box);
    const std::vector<int> near = NearIn(box, sites);
    if (parts.size() == 1) return SplitBox(parts.front(), box, near, 0);
    const int axis = box.half().x() >= box.half().y() ? 0 : 1;
    const std::size_t middle = parts.size() / 2;
    std::ranges::nth_element(parts, parts.begin() + static_cast<std::ptrdiff_t>(middle), {},
                             [&](const Part& part) { return part.box.centre()[axis]; });
    SplitParts(parts.first(middle), near);
    SplitParts(parts.subspan(middle), near);
  }

  void SplitBox(const Part& part, const Box& box, const std::vector<int>& sites, int vain) {
    if (box.half().maxCoeff() <= rounding_) return;
    const std::vector<int> near = NearIn(box, sites);
    vain = near.size() < sites.size() ? 0 : vain + 1;
    if (near.size() <= kFewSites || vain > kVainHalvings) return AddEdges(part, box, near);
    const int axis = box.half().x() >= box.half().y() ? 0 : 1;
    Box lower = box, upper = box;
    lower.high[axis] = upper.low[axis] = box.centre()[axis];
    SplitBox(part, lower, near, vain);
    SplitBox(part, upper, near, vain);
  }

  /// Add the edges of the diagram in a box in which only the given sites can be nearest.
  ///
  /// For two terms of different sites, an edge is a part of the line on which they are equal.
  /// There, both are the distances of their sites, and no other site is nearer.
  void AddEdges(const Part& part, const Box& box, const std::vector<int>& sites) {
    std::vector<std::vector<Term>> active;
    for (const int site : sites) active.push_back(ActiveTerms(sites_[site], box));
    const std::size_t first = edges_.size();
    for (std::size_t s = 0; s < sites.size(); ++s) {
      for (std::size_t t = s + 1; t < sites.size(); ++t) {
        for (const Term& a : active[s]) {
          for (const Term& b : active[t]) {
            AddBisector(part, box, active, {s, t}, {a, b}, first);
          }
        }
      }
    }
  }

  void AddBisector(const Part& part, const Box& box, const std::vector<std::vector<Term>>& active,
                   const std::array<std::size_t, 2>& owners, const std::array<Term, 2>& terms,
                   std::size_t first) {
    const Term difference = terms[0] - terms[1];
    const double square = difference.g.squaredNorm();
    if (square <= kSameSlope) return;
    const Vector2d foot = box.centre() - difference(box.centre()) / square * difference.g;
    const Vector2d along = Vector2d(-difference.g.y(), difference.g.x()).normalized();
    const double reach = 2 * box.half().norm();
    LinePart line = {foot, along, -reach, reach};
    for (int axis = 0; axis < 2; ++axis) {
      line.Clip({Vector2d::Unit(axis), -box.low[axis]});
      line.Clip({-Vector2d::Unit(axis), box.high[axis]});
    }
    for (int k = 0; k < 2; ++k) {
      for (const Term& other : active[owners[k]]) line.Clip(Raise(terms[k] - other, rounding_));
    }
    ClipToOutline(part.outline, line);
    if (line.high - line.low <= rounding_) return;
    std::vector<LinePart> parts = {line};
    for (std::size_t r = 0; r < active.size() && !parts.empty(); ++r) {
      if (r != owners[0] && r != owners[1]) RemoveNearer(active[r], terms[0], parts);
    }
    for (const LinePart& rest : parts) AddEdge(part.piece, rest, terms[0], first);
  }

  static void ClipToOutline(const std::vector<Vector2d>& outline, LinePart& line) {
    for (std::size_t i = 0; i < outline.size() && !line.empty(); ++i) {
      const Vector2d side = outline[(i + 1) % outline.size()] - outline[i];
      const Vector2d left(-side.y(), side.x());
      line.Clip({left, -left.dot(outline[i])});
    }
  }

  /// Remove the parts on which another site with these terms is nearer than `term`.
  void RemoveNearer(const std::vector<Term>& site, const Term& term,
                    std::vector<LinePart>& parts) const {
    std::vector<LinePart> kept;
    for (const LinePart& part : parts) {
      LinePart nearer = part;
      for (const Term& other : site) nearer.Clip(Raise(term - other, -rounding_));
      if (nearer.empty()) {
        kept.push_back(part);
        continue;
      }
      LinePart before = part, after = part;
      before.high = nearer.low;
      after.low = nearer.high;
      if (before.high - before.low > rounding_) kept.push_back(before);
      if (after.high - after.low > rounding_) kept.push_back(after);
    }
    parts = std::move(kept);
  }

  /// Add an edge unless it is known: if more than two sites are equally near, several pairs have
  /// the same edge.
  void AddEdge(PieceIndex piece, const LinePart& line, const Term& size, std::size_t first) {
    const DiagramEdge edge = {piece, line.At(line.low), line.At(line.high), size(line.At(line.low)),
                              size(line.At(line.high))};
    const auto near = [&](const Vector2d& a, const Vector2d& b) {
      return (a - b).lpNorm<Eigen::Infinity>() <= kSameEnd * rounding_;
    };
    const bool known = std::any_of(edges_.begin() + static_cast<std::ptrdiff_t>(first),
                                   edges_.end(), [&](const DiagramEdge& e) {
                                     return (near(e.from, edge.from) && near(e.to, edge.to)) ||
                                            (near(e.from, edge.to) && near(e.to, edge.from));
                                   });
    if (!known) edges_.push_back(edge);
  }

  /// Squared difference below which slopes are equal; the terms then differ by a constant.
  static constexpr double kSameSlope = 1e-20;
  /// Largest distance between equal ends of an edge that was found twice, in roundings.
  static constexpr double kSameEnd = 100;

  const ContourGraph& graph_;
  const std::vector<Site>& sites_;
  double rounding_;
  const Deadline& deadline_;
  std::vector<double> distances_;
  std::vector<DiagramEdge> edges_;
};

Site MakeSite(const Vector2d& from, const Vector2d& to) {
  Site site = {from.cwiseMin(to), from.cwiseMax(to)};
  const Vector2d extent = site.high - site.low;
  if (extent.x() == 0 || extent.y() == 0) return site;
  site.normal = Vector2d(extent.y(), extent.x()) / extent.sum();
  site.offset = site.normal.dot(from + to) / 2;
  return site;
}

Site Shift(Site site, const Vector2d& by) {
  site.low += by;
  site.high += by;
  site.offset += site.normal.dot(by);
  return site;
}

/// Return an upper bound on the half-width of squares inside a set: half of the set's largest
/// extent in one contact's place for a fixed place of the other contact.
double LargestSize(const ContourGraph& graph, sets::SetIndex set) {
  std::vector<double> widths(graph.boundary().edge_count());
  const object::Polygon& polygon = graph.boundary().polygon();
  for (const PieceIndex piece : graph.pieces_of(set)) {
    const auto& edges = graph.pieces()[piece].edges;
    for (int k = 0; k < 2; ++k) widths[edges[k]] += polygon.face_measure(edges[1 - k]);
  }
  return *std::ranges::max_element(widths) / 2;
}

}  // namespace

RegionMetric::RegionMetric(const ContourGraph& graph, sets::SetIndex set)
    : graph_(graph), set_(set) {
  const Boundary& boundary = graph.boundary();
  const GraspPiece& any = graph.pieces()[graph.pieces_of(set).front()];
  const std::array rings = {boundary.ring_of(any.edges[0]), boundary.ring_of(any.edges[1])};
  const Vector2d period(boundary.perimeter(rings[0]), boundary.perimeter(rings[1]));
  Box extent = {Vector2d::Constant(std::numeric_limits<double>::infinity()),
                Vector2d::Constant(-std::numeric_limits<double>::infinity())};
  for (const PieceIndex piece : graph.pieces_of(set)) {
    const auto& [a, b] = graph.pieces()[piece].edges;
    extent.Include({{boundary.begin(a), boundary.begin(b)}, {boundary.end(a), boundary.end(b)}});
  }
  const double reach = LargestSize(graph, set);
  const auto add = [&](const Site& site) {
    for (const int i : {-1, 0, 1}) {
      for (const int j : {-1, 0, 1}) {
        const Site copy = Shift(site, {i * period.x(), j * period.y()});
        const bool near = ((copy.low - extent.high).array() <= reach).all() &&
                          ((extent.low - copy.high).array() <= reach).all();
        if (near) sites_.push_back(copy);
      }
    }
  };
  for (const BorderSegment& segment : SetBorder(graph, set)) {
    add(MakeSite(segment.from, segment.to));
    if (rings[0] == rings[1]) {
      add(MakeSite(segment.from.reverse().eval(), segment.to.reverse().eval()));
    }
  }
  rounding_ = kDiagramRounding * period.maxCoeff();
}

double RegionMetric::SizeAt(const Vector2d& point) const {
  double size = std::numeric_limits<double>::infinity();
  for (const Site& site : sites_) size = std::min(size, Distance(site, point));
  return size;
}

std::vector<DiagramEdge> RegionMetric::MakeDiagram(const Deadline& deadline) const {
  return DiagramMaker(graph_, sites_, rounding_, deadline).Make(graph_.pieces_of(set_));
}

}  // namespace regrasp::contour
