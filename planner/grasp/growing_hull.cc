#include "planner/grasp/growing_hull.h"

#include <algorithm>
#include <cmath>

namespace regrasp::grasp {

namespace {

/// Points are shrunk by between a half and one and a half of this part. Far above the rounding of a
/// height, far below any gap that a search asks for.
constexpr double kShrink = 1e-7;

/// The golden ratio's fraction: its multiples spread evenly and repeat no pattern.
constexpr double kSpread = 0.6180339887498949;

/// Heights below this may be rounding.
constexpr double kLeastHeight = 1e-10;

template <typename Array>
int PlaceIn(const Array& values, int value) {
  return static_cast<int>(std::ranges::find(values, value) - values.begin());
}

/// Corner i of kDim + 1 of the regular simplex with unit corners about the origin.
template <int kDim>
Eigen::Matrix<double, kDim, 1> SimplexCorner(int i) {
  using Vector = Eigen::Matrix<double, kDim, 1>;
  const double n = kDim;
  const double last = (1 - std::sqrt(n + 1)) / n;
  const double mean = (1 + last) / (n + 1);
  Vector corner = Vector::Constant(i == kDim ? last - mean : -mean);
  if (i < kDim) corner[i] += 1;
  return corner.normalized();
}

}  // namespace

template <int kDim>
void GrowingHull<kDim>::Start(double radius) {
  points_.clear();
  facets_.clear();
  free_.clear();
  heap_.clear();
  serials_ = 0;
  created_ = 0;
  for (int i = 0; i <= kDim; ++i) points_.push_back(radius * SimplexCorner<kDim>(i));
  for (int opposite = 0; opposite <= kDim; ++opposite) {
    const int facet = NewPlace();
    Facet& made = facets_[facet];
    made.pole = -kDim / (radius * radius) * points_[opposite];
    made.visit = kFree;
    int place = 0;
    for (int i = 0; i <= kDim; ++i) {
      if (i == opposite) continue;
      made.corners[place] = i;
      made.neighbours[place++] = i;  // facet i is the one opposite to corner i
    }
    Push(facet);
  }
}

template <int kDim>
typename GrowingHull<kDim>::Plane GrowingHull<kDim>::Nearest() {
  while (facets_[heap_.front().facet].serial != heap_.front().serial) {
    std::ranges::pop_heap(heap_, {}, &Entry::pole_squared);
    heap_.pop_back();
  }
  const int facet = heap_.front().facet;
  const double distance = 1 / std::sqrt(heap_.front().pole_squared);
  return {facet, distance, distance * facets_[facet].pole};
}

template <int kDim>
bool GrowingHull<kDim>::Insert(int facet, const Vector& point) {
  point_ = static_cast<int>(points_.size());
  const double turn = kSpread * point_;
  points_.push_back((1 - kShrink * (0.5 + turn - std::floor(turn))) * point);
  if (!(HeightOf(facet) > kLeastHeight)) return false;
  FindVisible(facet);
  AddFacets();
  if (!LinkFacets()) return false;
  for (const int gone : visible_) {
    facets_[gone].serial = kFree;
    free_.push_back(gone);
  }
  for (const int added : added_) Push(added);
  return true;
}

template <int kDim>
double GrowingHull<kDim>::Residual() const {
  double largest = 0;
  for (const Facet& facet : facets_) {
    if (facet.serial == kFree) continue;
    for (const int corner : facet.corners) {
      largest = std::max(largest, std::abs(facet.pole.dot(points_[corner]) - 1));
    }
  }
  return largest;
}

template <int kDim>
double GrowingHull<kDim>::HeightOf(int facet) {
  Facet& of = facets_[facet];
  if (of.visit != point_) {
    of.visit = point_;
    of.height = of.pole.dot(points_[point_]) - 1;
  }
  return of.height;
}

/// Visible facets are connected: those that the point is beyond are found from neighbour to
/// neighbour.
template <int kDim>
void GrowingHull<kDim>::FindVisible(int start) {
  visible_.assign(1, start);
  horizon_.clear();
  // The start is marked as seen by its height; another visible facet is when it is found.
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    const int facet = visible_[i];
    for (int place = 0; place < kDim; ++place) {
      const int neighbour = facets_[facet].neighbours[place];
      const bool seen = facets_[neighbour].visit == point_;
      if (!(HeightOf(neighbour) > 0)) {
        horizon_.push_back({facet, place});
      } else if (!seen) {
        visible_.push_back(neighbour);
      }
    }
  }
}

/// A facet for every ridge on the horizon, with the point in the place of the ridge's missing
/// corner.
template <int kDim>
void GrowingHull<kDim>::AddFacets() {
  added_.clear();
  for (const Ridge& ridge : horizon_) {
    const int index = NewPlace();
    Facet& inner = facets_[ridge.facet];
    const int beyond = inner.neighbours[ridge.place];
    Facet& outer = facets_[beyond];
    Facet& made = facets_[index];
    const double part = -outer.height / (inner.height - outer.height);
    made.pole = outer.pole + part * (inner.pole - outer.pole);
    made.visit = kFree;
    made.corners = inner.corners;
    made.corners[ridge.place] = point_;
    made.neighbours.fill(kUnlinked);
    made.neighbours[ridge.place] = beyond;
    outer.neighbours[PlaceIn(outer.neighbours, ridge.facet)] = index;
    inner.neighbours[ridge.place] = Replaced(index);
    added_.push_back(index);
  }
}

template <int kDim>
bool GrowingHull<kDim>::LinkFacets() {
  for (std::size_t i = 0; i < added_.size(); ++i) {
    Facet& made = facets_[added_[i]];
    for (int place = 0; place < kDim; ++place) {
      if (made.neighbours[place] != kUnlinked) continue;
      const std::optional<Ridge> found = FollowRidge(horizon_[i], place);
      if (!found) return false;
      made.neighbours[place] = found->facet;
      facets_[found->facet].neighbours[found->place] = added_[i];
    }
  }
  return true;
}

/// Visible facets that share all corners of the ridge but the dropped one follow each other like
/// the pages of a book. Each has two corners besides: one is dropped to reach the next facet, the
/// other is dropped there.
template <int kDim>
std::optional<typename GrowingHull<kDim>::Ridge> GrowingHull<kDim>::FollowRidge(Ridge from,
                                                                               int dropped) const {
  int facet = from.facet;
  int kept = from.place;
  for (std::size_t page = 0; page <= visible_.size(); ++page) {
    const int next = facets_[facet].neighbours[dropped];
    if (next < kUnlinked) return Ridge{kUnlinked - 1 - next, kept};
    const int corner = facets_[facet].corners[kept];
    kept = PlaceIn(facets_[next].neighbours, facet);
    dropped = PlaceIn(facets_[next].corners, corner);
    if (kept == kDim || dropped == kDim) return std::nullopt;
    facet = next;
  }
  return std::nullopt;
}

template <int kDim>
int GrowingHull<kDim>::NewPlace() {
  int place = static_cast<int>(facets_.size());
  if (free_.empty()) {
    facets_.emplace_back();
  } else {
    place = free_.back();
    free_.pop_back();
  }
  facets_[place].serial = serials_++;
  ++created_;
  return place;
}

template <int kDim>
void GrowingHull<kDim>::Push(int facet) {
  heap_.push_back({facets_[facet].pole.squaredNorm(), facet, facets_[facet].serial});
  std::ranges::push_heap(heap_, {}, &Entry::pole_squared);
}

template class GrowingHull<3>;
template class GrowingHull<6>;

}  // namespace regrasp::grasp
