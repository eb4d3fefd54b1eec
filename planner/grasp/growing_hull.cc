#include "planner/grasp/growing_hull.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>

namespace regrasp::grasp {

namespace {

/// Mean relative shrinkage of points; each is shrunk by between a half and one and a half of it.
/// Much larger than the rounding of a height, much smaller than the gap of any search.
constexpr double kShrink = 1e-7;

/// Fractional part of the golden ratio: its multiples spread evenly without a repeated pattern.
constexpr double kSpread = 0.6180339887498949;

/// Height below which a value may be rounding.
constexpr double kLeastHeight = 1e-10;

/// Return the index of a value that occurs once.
/// Without a branch, which would be mispredicted.
template <typename Array>
int PlaceIn(const Array& values, int value) {
  int place = 0;
  for (int i = 1; i < static_cast<int>(values.size()); ++i) place = values[i] == value ? i : place;
  return place;
}

/// Return corner i of kDim + 1 of the regular simplex with unit corners about the origin.
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
  links_.clear();
  free_.clear();
  heap_.clear();
  least_pole_squared_ = 0;
  serials_ = 0;
  created_ = 0;
  for (int i = 0; i <= kDim; ++i) points_.push_back(radius * SimplexCorner<kDim>(i));
  for (int opposite = 0; opposite <= kDim; ++opposite) {
    const int facet = NewPlace();
    facets_[facet].pole = -kDim / (radius * radius) * points_[opposite];
    int place = 0;
    for (int i = 0; i <= kDim; ++i) {
      if (i == opposite) continue;
      links_[facet].corners[place] = static_cast<std::int16_t>(i);
      // Facet i is opposite to corner i, and has all other corners in order.
      links_[facet].back[place] = static_cast<std::int8_t>(opposite - (opposite > i ? 1 : 0));
      links_[facet].neighbours[place++] = i;
    }
    Push(facet);
  }
}

template <int kDim>
std::optional<typename GrowingHull<kDim>::Plane> GrowingHull<kDim>::Nearest() {
  while (!heap_.empty() && facets_[heap_.front().facet].serial != heap_.front().serial) {
    std::ranges::pop_heap(heap_, {}, &Entry::pole_squared);
    heap_.pop_back();
  }
  if (heap_.empty() || heap_.front().pole_squared <= least_pole_squared_) return std::nullopt;
  const int facet = heap_.front().facet;
  const double distance = 1 / std::sqrt(heap_.front().pole_squared);
  return Plane{facet, distance, distance * facets_[facet].pole};
}

template <int kDim>
bool GrowingHull<kDim>::Insert(int facet, const Vector& point) {
  point_ = static_cast<int>(points_.size());
  if (point_ > std::numeric_limits<std::int16_t>::max()) return false;
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
  for (std::size_t i = 0; i < facets_.size(); ++i) {
    if (facets_[i].serial == kFree) continue;
    for (const int corner : links_[i].corners) {
      // A value that is not a number also counts as larger than any limit.
      const double residual = std::abs(facets_[i].pole.dot(points_[corner]) - 1);
      if (!(residual <= largest)) largest = residual;
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

/// Find the visible facets: those that the point is beyond.
/// They are connected, so the search visits neighbours only.
template <int kDim>
void GrowingHull<kDim>::FindVisible(int start) {
  visible_.assign(1, start);
  horizon_.clear();
  // The start is already marked by its height; all others are marked when they are found.
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    const int facet = visible_[i];
    for (int place = 0; place < kDim; ++place) {
      const int neighbour = links_[facet].neighbours[place];
      const bool seen = facets_[neighbour].visit == point_;
      if (!(HeightOf(neighbour) > 0)) {
        horizon_.push_back({facet, place});
      } else if (!seen) {
        visible_.push_back(neighbour);
      }
    }
  }
}

/// Add a facet for every ridge on the horizon.
/// The new facet has the inserted point instead of the ridge's missing corner.
template <int kDim>
void GrowingHull<kDim>::AddFacets() {
  added_.clear();
  for (const Ridge& ridge : horizon_) {
    const int made = NewPlace();
    Links& inner = links_[ridge.facet];
    const int beyond = inner.neighbours[ridge.place];
    const double height = facets_[beyond].height;
    const double part = -height / (facets_[ridge.facet].height - height);
    const Vector& pole = facets_[beyond].pole;
    facets_[made].pole = pole + part * (facets_[ridge.facet].pole - pole);
    links_[made].corners = inner.corners;
    links_[made].corners[ridge.place] = static_cast<std::int16_t>(point_);
    links_[made].neighbours.fill(kUnlinked);
    Link({made, ridge.place}, {beyond, inner.back[ridge.place]});
    inner.neighbours[ridge.place] = Code(made);
    added_.push_back(made);
  }
}

template <int kDim>
bool GrowingHull<kDim>::LinkFacets() {
  for (std::size_t i = 0; i < added_.size(); ++i) {
    const std::array<int, kDim>& neighbours = links_[added_[i]].neighbours;
    for (int place = 0; place < kDim; ++place) {
      if (neighbours[place] != kUnlinked) continue;
      const std::optional<Ridge> found = FollowRidge(horizon_[i], place);
      if (!found) return false;
      Link({added_[i], place}, *found);
    }
  }
  return true;
}

template <int kDim>
void GrowingHull<kDim>::Link(Ridge a, Ridge b) {
  links_[a.facet].neighbours[a.place] = b.facet;
  links_[a.facet].back[a.place] = static_cast<std::int8_t>(b.place);
  links_[b.facet].neighbours[b.place] = a.facet;
  links_[b.facet].back[b.place] = static_cast<std::int8_t>(a.place);
}

/// Follow the visible facets about a ridge to the new facet on the far side.
/// Visible facets that share all corners of the ridge except the dropped one form a sequence. Each
/// has two further corners. Dropping one yields the next, in which the other corner is dropped.
template <int kDim>
std::optional<typename GrowingHull<kDim>::Ridge> GrowingHull<kDim>::FollowRidge(Ridge from,
                                                                                int dropped) const {
  const Links* facet = &links_[from.facet];
  int kept = from.place;
  for (std::size_t page = 0; page <= visible_.size(); ++page) {
    const int next = facet->neighbours[dropped];
    if (next < kUnlinked) return Ridge{Code(next), kept};
    const int corner = facet->corners[kept];
    kept = facet->back[dropped];
    facet = &links_[next];
    dropped = PlaceIn(facet->corners, corner);
  }
  return std::nullopt;
}

template <int kDim>
int GrowingHull<kDim>::NewPlace() {
  int place = static_cast<int>(facets_.size());
  if (free_.empty()) {
    facets_.emplace_back();
    links_.emplace_back();
  } else {
    place = free_.back();
    free_.pop_back();
  }
  facets_[place].visit = kFree;
  facets_[place].serial = serials_++;
  ++created_;
  return place;
}

template <int kDim>
void GrowingHull<kDim>::Push(int facet) {
  const double pole_squared = facets_[facet].pole.squaredNorm();
  if (pole_squared <= least_pole_squared_) return;
  heap_.push_back({pole_squared, facet, facets_[facet].serial});
  std::ranges::push_heap(heap_, {}, &Entry::pole_squared);
}

template class GrowingHull<3>;
template class GrowingHull<6>;

}  // namespace regrasp::grasp

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace regrasp::grasp {
namespace {

/// State of Qhull: freed by the destructor, with messages discarded.
class QhullRun {
 public:
  QhullRun() : messages_(std::fopen("/dev/null", "w"), &std::fclose) { qh_zero(&qh_, stderr); }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;
  ~QhullRun() {
    qh_freeqhull(&qh_, !qh_ALL);
    int current_long = 0;
    int total_long = 0;
    qh_memfreeshort(&qh_, &current_long, &total_long);
  }

  void Compute(Eigen::MatrixXd& points) {
    std::string command = "qhull QJ";
    const int status =
        qh_new_qhull(&qh_, static_cast<int>(points.rows()), static_cast<int>(points.cols()),
                     points.data(), False, command.data(), nullptr, messages_.get());
    if (status != 0) {
      throw std::runtime_error("convex hull: Qhull ended with code " + std::to_string(status));
    }
  }

  [[nodiscard]] qhT& qh() { return qh_; }

 private:
  qhT qh_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> messages_;
};

}  // namespace

ConvexHull ComputeConvexHull(const Eigen::MatrixXd& points) {
  Eigen::MatrixXd joggled = points;
  QhullRun run;
  run.Compute(joggled);
  ConvexHull hull;
  qhT* qh = &run.qh();
  // The joggle moves each coordinate by up to JOGGLEmax, and a point by √dimension times that.
  hull.joggle = 2 * qh->JOGGLEmax * std::sqrt(static_cast<double>(points.rows()));
  facetT* facet = nullptr;
  FORALLfacets {
    hull.facets.push_back(
        {Eigen::Map<const Eigen::VectorXd>(facet->normal, points.rows()), -facet->offset});
  }
  return hull;
}

}  // namespace regrasp::grasp
