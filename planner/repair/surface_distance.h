#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "planner/object/polygon_soup.h"

namespace regrasp::repair {

/// The distance of points to a set of triangles, and what rays meet of them.
class SurfaceDistance {
 public:
  /// @param triangles  facets of three corners; those without area are passed over.
  /// @throws std::runtime_error  none has one.
  explicit SurfaceDistance(const object::PolygonSoup& triangles);
  ~SurfaceDistance();
  SurfaceDistance(SurfaceDistance&&) noexcept;

  struct Closest {
    Eigen::Vector3d point;
    int facet;
    int triangle;  ///< by which the next search knows it
  };
  /// @param near  what was found for a point nearby: the search is as short as that is close.
  [[nodiscard]] Closest FindClosest(const Eigen::Vector3d& point,
                                    const std::optional<Closest>& near = std::nullopt) const;
  /// The distance to the one triangle that was found for another point.
  [[nodiscard]] double DistanceTo(const Eigen::Vector3d& point, const Closest& found) const;
  [[nodiscard]] Eigen::Vector3d ClosestPoint(const Eigen::Vector3d& point) const {
    return FindClosest(point).point;
  }
  [[nodiscard]] double DistanceTo(const Eigen::Vector3d& point) const {
    return (ClosestPoint(point) - point).norm();
  }
  /// True iff a ray from `point` meets a triangle.
  [[nodiscard]] bool IsHit(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) const;
  /// How far along a ray, whose direction has length 1, the first triangle is; infinity without.
  [[nodiscard]] double FirstHit(const Eigen::Vector3d& point,
                                const Eigen::Vector3d& direction) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace regrasp::repair
