#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "planner/object/polygon_soup.h"

namespace regrasp::repair {

/// Distance of points to a set of triangles, and ray casts against them.
class SurfaceDistance {
 public:
  /// @param triangles  surface of triangles; degenerate ones are ignored.
  /// @throws std::runtime_error  if all are degenerate.
  explicit SurfaceDistance(const object::PolygonSoup& triangles);
  ~SurfaceDistance();
  SurfaceDistance(SurfaceDistance&&) noexcept;

  struct Closest {
    Eigen::Vector3d point;
    int facet;
    int triangle;  ///< index of the triangle in the tree, a hint for the next search
  };
  /// Find the point of the surface nearest to `point`.
  /// @param near  result for a nearby point, optional. The closer that point, the faster the
  ///     search.
  [[nodiscard]] Closest FindClosest(const Eigen::Vector3d& point,
                                    const std::optional<Closest>& near = std::nullopt) const;
  /// Return the distance to the triangle found for another point.
  [[nodiscard]] double DistanceTo(const Eigen::Vector3d& point, const Closest& found) const;
  [[nodiscard]] Eigen::Vector3d ClosestPoint(const Eigen::Vector3d& point) const {
    return FindClosest(point).point;
  }
  [[nodiscard]] double DistanceTo(const Eigen::Vector3d& point) const {
    return (ClosestPoint(point) - point).norm();
  }
  /// Return true iff a ray from `point` hits a triangle.
  [[nodiscard]] bool IsHit(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) const;
  /// Return the distance of the first hit along a ray; infinity if there is none.
  /// @param direction  unit vector.
  [[nodiscard]] double FirstHit(const Eigen::Vector3d& point,
                                const Eigen::Vector3d& direction) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace regrasp::repair
