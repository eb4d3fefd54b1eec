#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "planner/object/object.h"

namespace regrasp::object {

/// Rings of a polygon, outer ring first; a ring's last point is not repeated.
using PolygonRings = std::vector<std::vector<Eigen::Vector2d>>;

/// Check that rings bound one connected sheet, and orient them.
///
/// The outer ring becomes counter-clockwise and holes clockwise; their first points stay first. The
/// requirements are those of Polygon::FromRings.
/// @throws InputError  if a requirement is not met.
void CheckAndOrientRings(PolygonRings& rings, const std::string& name);

/// Read the rings of a WKT POLYGON, or of a MULTIPOLYGON with one polygon, without checking them.
///
/// The syntax is that of Polygon::FromWkt.
/// @throws InputError  if the syntax is wrong.
[[nodiscard]] PolygonRings ReadWktRings(std::string_view text, const std::string& name);

/// A simple polygon in the plane z = 0, with or without holes.
///
/// Its faces are its edges: those of the outer ring (counter-clockwise), then those of each hole
/// (clockwise). The material is on the left of every edge.
class Polygon final : public Object {
 public:
  /// Make a polygon from rings, which are checked and oriented.
  ///
  /// Rings must be simple. Holes must be strictly inside the outer ring, and must not touch or
  /// contain each other. Exact predicates decide this. Collinear adjacent edges stay separate
  /// edges.
  /// @param rings  points of each ring, outer ring first; a ring's last point is not repeated.
  /// @throws InputError  if a requirement is not met; names the ring, the vertex or edge (from 0)
  ///     and the problem.
  static Polygon FromRings(std::vector<std::vector<Eigen::Vector2d>> rings,
                           const std::string& name);

  /// Read `POLYGON((x y, …),(hole …))`, or a MULTIPOLYGON with one polygon (OGC 06-103r4).
  ///
  /// Case and white space are arbitrary; each ring ends with its first point. The result does not
  /// depend on the locale.
  /// @throws InputError  if the text is invalid; names the ring and vertex, or the position in the
  ///     text.
  static Polygon FromWkt(std::string_view text, const std::string& name);

  /// Rings, outer ring first.
  [[nodiscard]] const std::vector<std::vector<Eigen::Vector2d>>& rings() const { return rings_; }
  /// Ends of an edge, with the material on the left.
  [[nodiscard]] std::pair<Eigen::Vector3d, Eigen::Vector3d> edge(FaceIndex face) const {
    return {BordersOf(face)[0].a, BordersOf(face)[1].a};
  }

  [[nodiscard]] Eigen::Vector3d ClosestPoint(FaceIndex face,
                                             const Eigen::Vector3d& point) const override;
  [[nodiscard]] std::vector<FaceIndex> FacesNear(const Eigen::Vector3d& point,
                                                 double tolerance) const override;
  [[nodiscard]] std::vector<FaceIndex> FacesNearSegment(const Eigen::Vector3d& a,
                                                        const Eigen::Vector3d& b,
                                                        double tolerance) const override;
  [[nodiscard]] double DistanceToBorder(FaceIndex face,
                                        const Eigen::Vector3d& point) const override;
  [[nodiscard]] bool ContainsSegment(FaceIndex face, const Eigen::Vector3d& a,
                                     const Eigen::Vector3d& b, double tolerance) const override;

 private:
  Polygon(std::vector<std::vector<Eigen::Vector2d>> rings, double diameter,
          MassProperties mass_properties);

  std::vector<std::vector<Eigen::Vector2d>> rings_;
  /// Ends of each edge. They are adjacent in memory because searches read all of them.
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> edges_;
};

/// Cut a polygon into counter-clockwise triangles without new vertices.
///
/// The method is a constrained Delaunay triangulation with exact predicates.
/// @returns three vertex indices per triangle; vertices are numbered through all rings in order.
[[nodiscard]] std::vector<std::array<int, 3>> TriangulatePolygon(const Polygon& polygon);

}  // namespace regrasp::object
