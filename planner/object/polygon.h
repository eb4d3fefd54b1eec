#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "planner/object/object.h"

namespace regrasp::object {

/// Rings of a polygon, the outer one first; a ring's last point is not repeated.
using PolygonRings = std::vector<std::vector<Eigen::Vector2d>>;

/// Checks that rings bound one connected sheet and turns the outer one counter-clockwise and holes
/// clockwise (their first points stay first). As Polygon::FromRings says.
/// @throws InputError
void CheckAndOrientRings(PolygonRings& rings, const std::string& name);

/// The rings of a WKT POLYGON or a MULTIPOLYGON of one polygon, unchecked. As Polygon::FromWkt
/// says.
/// @throws InputError
[[nodiscard]] PolygonRings ReadWktRings(std::string_view text, const std::string& name);

/// A simple polygon, with or without holes, in the plane z = 0.
///
/// Faces are its edges: those of the outer ring (counter-clockwise), then of each hole (clockwise),
/// so that the material is on the left of every edge.
class Polygon final : public Object {
 public:
  /// Checks and orients rings, the outer one first; a ring's last point is not repeated.
  ///
  /// Rings must be simple, holes strictly inside the outer ring and not inside or touching each
  /// other, all decided with exact predicates. Collinear neighbouring edges stay separate edges.
  /// @throws InputError  names the ring, the vertex or edge (from 0) and what is wrong.
  static Polygon FromRings(std::vector<std::vector<Eigen::Vector2d>> rings,
                           const std::string& name);

  /// Reads `POLYGON((x y, …),(hole …))` or a MULTIPOLYGON of one polygon (OGC 06-103r4): any case
  /// and white space; each ring ends with its first point. The same under any locale.
  /// @throws InputError  names the ring and vertex, or the place in the text.
  static Polygon FromWkt(std::string_view text, const std::string& name);

  /// The outer ring first.
  [[nodiscard]] const std::vector<std::vector<Eigen::Vector2d>>& rings() const { return rings_; }
  /// The two ends of an edge, material on the left.
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
  /// By edge, its ends: side by side in memory, as searches look at them all.
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> edges_;
};

/// Cuts a polygon into counter-clockwise triangles without new vertices (a constrained Delaunay
/// triangulation with exact predicates).
/// @returns three vertices each, numbered over the rings in their order.
[[nodiscard]] std::vector<std::array<int, 3>> TriangulatePolygon(const Polygon& polygon);

}  // namespace regrasp::object
