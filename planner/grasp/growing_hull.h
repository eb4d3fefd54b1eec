#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace regrasp::grasp {

/// A convex hull around the origin that grows point by point (beneath-beyond method).
///
/// The hull starts as a small simplex about the origin, so that the origin is inside at all times
/// and every facet has a pole: the y with y · x = 1 on the facet, of length 1 / distance. The pole
/// of a new facet lies on the segment between the poles of the two old facets that meet in its
/// ridge on the horizon. A facet therefore costs some kDim multiplications, not a linear system.
///
/// Every point is shrunk towards the origin by a different part, about 1e-7, of its length. Planes
/// through more than kDim points, as symmetric grasps have, thus do not occur, and the hull still
/// lies inside every convex set that contains the origin and the points.
template <int kDim>
class GrowingHull {
 public:
  using Vector = Eigen::Matrix<double, kDim, 1>;

  /// A facet with its unit normal and its distance from the origin.
  struct Plane {
    int facet = 0;
    double distance = 0;
    Vector normal = Vector::Zero();
  };

  /// Starts from a regular simplex about the origin whose corners are `radius` away from it. Memory
  /// of an earlier hull is used again.
  void Start(double radius);

  /// Facets that are created at this distance or beyond need not be found by Nearest. A limit may
  /// become smaller, never larger, until the next Start.
  void SetLimit(double distance) { least_pole_squared_ = 1 / (distance * distance); }

  /// The facet nearest to the origin; none if all are at the limit or beyond it.
  [[nodiscard]] std::optional<Plane> Nearest();

  /// Inserts a point beyond a facet.
  /// @returns false if the point is not beyond the facet, or if rounding leaves facets without
  ///          neighbours; the hull is then unusable until the next Start.
  [[nodiscard]] bool Insert(int facet, const Vector& point);

  /// The largest |pole · corner − 1| over all facets and their corners: how far rounding has moved
  /// a facet from its corners, over its distance from the origin.
  [[nodiscard]] double Residual() const;

  /// Number of facets that were created since Start.
  [[nodiscard]] std::int64_t created() const { return created_; }

 private:
  /// What a facet is: kept apart from its neighbours, of which far more is read.
  struct Facet {
    Vector pole;
    double height;  ///< pole · point − 1 for the point of `visit`
    int visit;      ///< the last inserted point that the height was taken of
    int serial;     ///< unique over all facets; kFree for a free place
  };
  /// Neighbour [i] shares all corners but corners[i], and has this facet as its neighbour
  /// [back[i]].
  struct Links {
    std::array<int, kDim> neighbours;
    std::array<std::int16_t, kDim> corners;  ///< indices of points
    std::array<std::int8_t, kDim> back;
  };
  /// The ridge of a facet without its corner at `place`.
  struct Ridge {
    int facet;
    int place;
  };
  /// An entry of the heap, stale if the facet has another serial by now.
  struct Entry {
    double pole_squared;
    int facet;
    int serial;
  };

  static constexpr int kFree = -1;
  /// Neighbour of a new facet that is not linked yet. Lower values stand, in a visible facet, for
  /// the new facet at that ridge.
  static constexpr int kUnlinked = -1;
  /// The code of a new facet, and the facet of a code.
  [[nodiscard]] static int Code(int facet) { return kUnlinked - 1 - facet; }

  [[nodiscard]] double HeightOf(int facet);
  void FindVisible(int start);
  void AddFacets();
  [[nodiscard]] bool LinkFacets();
  void Link(Ridge a, Ridge b);
  /// The ridge of another new facet that is the same as the one of the new facet at `from` without
  /// the corner at place `dropped`; none if rounding broke the hull.
  [[nodiscard]] std::optional<Ridge> FollowRidge(Ridge from, int dropped) const;
  [[nodiscard]] int NewPlace();
  void Push(int facet);

  std::vector<Vector> points_;
  std::vector<Facet> facets_;
  std::vector<Links> links_;  ///< of the facets
  std::vector<int> free_;
  std::vector<Entry> heap_;
  std::vector<int> visible_, added_;
  std::vector<Ridge> horizon_;  ///< [i] is the ridge of added_[i] in a visible facet
  double least_pole_squared_ = 0;
  int point_ = 0;  ///< the one that is being inserted
  int serials_ = 0;
  std::int64_t created_ = 0;
};

extern template class GrowingHull<3>;
extern template class GrowingHull<6>;

}  // namespace regrasp::grasp
