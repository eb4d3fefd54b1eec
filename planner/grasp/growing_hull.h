#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace regrasp::grasp {

/// Convex hull around the origin that grows point by point (beneath-beyond method).
///
/// The hull starts as a small simplex about the origin. The origin is therefore always inside, and
/// every facet has a pole: the y with y · x = 1 on the facet, of length 1 / distance. The pole of a
/// new facet is on the segment between the poles of the two old facets that meet in its ridge on
/// the horizon. A facet therefore costs about kDim multiplications instead of a linear system.
///
/// Each point is shrunk towards the origin by a different part of its length, about 1e-7. Planes
/// through more than kDim points, which symmetric grasps have, therefore do not occur. The hull
/// still lies inside every convex set that contains the origin and the points.
template <int kDim>
class GrowingHull {
 public:
  using Vector = Eigen::Matrix<double, kDim, 1>;

  /// Facet with its unit normal and its distance from the origin.
  struct Plane {
    int facet = 0;
    double distance = 0;
    Vector normal = Vector::Zero();
  };

  /// Start from a regular simplex about the origin.
  /// Reuses the memory of an earlier hull.
  /// @param radius  distance of the corners from the origin.
  void Start(double radius);

  /// Let Nearest ignore facets that are created at this distance or beyond.
  /// Until the next Start the limit may only decrease.
  void SetLimit(double distance) { least_pole_squared_ = 1 / (distance * distance); }

  /// Return the facet nearest to the origin; nullopt if all are at the limit or beyond it.
  [[nodiscard]] std::optional<Plane> Nearest();

  /// Insert a point beyond a facet.
  /// @returns false if the point is not beyond the facet, or if rounding leaves facets without
  ///     neighbours; the hull is then unusable until the next Start.
  [[nodiscard]] bool Insert(int facet, const Vector& point);

  /// Return the largest |pole · corner − 1| over all facets and their corners.
  /// This is the distance by which rounding has moved a facet from its corners, relative to its
  /// distance from the origin.
  [[nodiscard]] double Residual() const;

  /// Number of facets created since Start.
  [[nodiscard]] std::int64_t created() const { return created_; }

 private:
  /// Geometry of a facet, stored separately from its links because most reads need only the links.
  struct Facet {
    Vector pole;
    double height;  ///< pole · point − 1 for the point of `visit`
    int visit;      ///< last inserted point for which the height was computed
    int serial;     ///< unique over all facets; kFree for a free place
  };
  /// Neighbours of a facet. Neighbour [i] shares all corners except corners[i], and has this facet
  /// as its neighbour [back[i]].
  struct Links {
    std::array<int, kDim> neighbours;
    std::array<std::int16_t, kDim> corners;  ///< indices of points
    std::array<std::int8_t, kDim> back;
  };
  /// Ridge of a facet: all its corners except the one at `place`.
  struct Ridge {
    int facet;
    int place;
  };
  /// Entry of the heap; stale if the facet has another serial.
  struct Entry {
    double pole_squared;
    int facet;
    int serial;
  };

  static constexpr int kFree = -1;
  /// Neighbour of a new facet that is not linked yet. In a visible facet, lower values are the code
  /// of the new facet at that ridge.
  static constexpr int kUnlinked = -1;
  /// Convert between a new facet and its code.
  [[nodiscard]] static int Code(int facet) { return kUnlinked - 1 - facet; }

  [[nodiscard]] double HeightOf(int facet);
  void FindVisible(int start);
  void AddFacets();
  [[nodiscard]] bool LinkFacets();
  void Link(Ridge a, Ridge b);
  /// Return the equal ridge of another new facet; nullopt if rounding broke the hull.
  /// @param from  new facet with the ridge.
  /// @param dropped  place of the corner that the ridge lacks.
  [[nodiscard]] std::optional<Ridge> FollowRidge(Ridge from, int dropped) const;
  [[nodiscard]] int NewPlace();
  void Push(int facet);

  std::vector<Vector> points_;
  std::vector<Facet> facets_;
  std::vector<Links> links_;  ///< links [facet]
  std::vector<int> free_;
  std::vector<Entry> heap_;
  std::vector<int> visible_, added_;
  std::vector<Ridge> horizon_;  ///< ridge of added_[i] in a visible facet [i]
  double least_pole_squared_ = 0;
  int point_ = 0;  ///< index of the point that is being inserted
  int serials_ = 0;
  std::int64_t created_ = 0;
};

extern template class GrowingHull<3>;
extern template class GrowingHull<6>;

/// Facet of a convex hull. normal · x <= offset for all x of the hull, |normal| = 1.
struct HullFacet {
  Eigen::VectorXd normal;
  double offset;
};

/// Facets of the convex hull of points in any dimension.
/// Computed with Qhull (Barber, Dobkin and Huhdanpaa 1996); its input is joggled so that all facets
/// are simplices.
struct ConvexHull {
  std::vector<HullFacet> facets;
  /// Distance by which the facets' half-spaces must move inwards so that the exact hull contains
  /// their intersection.
  double joggle = 0;
};

/// Compute the convex hull of points.
/// @param points  one point per column, of full dimension.
/// @throws std::runtime_error  if Qhull fails, because the points are not of full dimension.
[[nodiscard]] ConvexHull ComputeConvexHull(const Eigen::MatrixXd& points);

}  // namespace regrasp::grasp
